// section: 10.4.2
// value: A[1,3] = 5, A[3,1] = 7, r = 3, c = 3
model MixedConcat "blocks of matrices and scalars"
  Real v[2] = {1, 2}*time, B[2, 2] = {{1, 2}, {3, 4}}*time;
  Real A[3, 3] = [B, {5, 6}*time; 7*time, 8*time, 9*time];
  parameter Integer r = size([1, 2; 3, 4; 5, 6], 1), c = size([1, 2, 3], 2);
end MixedConcat;
