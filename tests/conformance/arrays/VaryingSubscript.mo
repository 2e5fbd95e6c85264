// section: 10.5
// value: y at 0.2 = 10, y = 30
model VaryingSubscript
  Integer k = 1 + integer(2.5*time);
  Real a[3] = {10, 20, 30};
  Real y = a[k];
end VaryingSubscript;
