// section: 10.1
// value: s = 16, n = 2
model SizeOfItself "a square matrix whose sizes come from its value"
  parameter Real A[:, size(A, 1)] = [1, 2; 3, 4];
  parameter Real B[size(A, 1), :] = [5; 1];
  Integer n = size(A, 2);
  Real s = sum(A) + sum(B);
end SizeOfItself;
