// section: 10.3.3
// refuse: R051 5
model MatrixOfTooMuch
  Real a[2, 2, 2] = fill(1.0, 2, 2, 2);
  Real m[2, 2] = matrix(a);
end MatrixOfTooMuch;
