// section: 8.6
// value: v = 0.8737841767950204, y = 0.8737841767950204, z = 0.8737841767950204
model StartOfAnyUnknown "the root next to a start value, whichever of the block's unknowns declares it"
  Real v(start=1), u, i, j;
  Real y, w(start=1), a, b;
  Real z, x, c(start=0.7), d;
equation
  i*v = 0.6;
  j = (1.02 - u)/0.1;
  i = (u - v)/0.1;
  j = i + 0.1*u^2;
  a*y = 0.6;
  b = (1.02 - w)/0.1;
  a = (w - y)/0.1;
  b = a + 0.1*w^2;
  c*z = 0.6;
  d = (1.02 - x)/0.1;
  c = (x - z)/0.1;
  d = c + 0.1*x^2;
end StartOfAnyUnknown;
