// section: 10.7
// value: Z[2,3] = 0
model EmptyArrays
  Real A[:, :] = fill(0.0, 0, 1);
  Boolean B[:, :, :] = fill(false, 0, 1, 0);
  Real[1, 0] a = fill(0.0, 1, 0);
  Real[0] a1a = a[1];
  Real[0] a1b = a[1, :];
  Real[0] a1c = a[1, 1:end];
  Real[3, 0] P = zeros(3, 0), Q = zeros(3, 0);
  Real[3, 0] R = P + Q;
  Real[2, 3] Z = fill(0.0, 2, 0)*fill(0.0, 0, 3);
end EmptyArrays;
