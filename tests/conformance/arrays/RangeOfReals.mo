// section: 10.4.3
// value: n = 3, x[2] = 0.75
model RangeOfReals
  Real x[3] = 0.5:0.25:1.0;
  Integer n = size(0.5:0.25:1.1, 1);
end RangeOfReals;
