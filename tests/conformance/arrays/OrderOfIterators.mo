// section: 10.4.1
// value: A[1,2] = 12, A[2,1] = 21, n1 = 2, n2 = 3
model OrderOfIterators
  Real A[3,2] = {10*i + j for j in 1:2, i in 1:3};
  Real B[2,3] = {{10*i+j for j in 1:3} for i in 1:2};
  Integer n1 = size(A, 2);
  Integer n2 = size(A, 1);
end OrderOfIterators;
