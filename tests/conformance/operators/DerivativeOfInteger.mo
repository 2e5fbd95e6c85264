// section: 3.7.4
// refuse: R054 5
model DerivativeOfInteger
  constant Integer k = 1;
  Real a = der(k);
end DerivativeOfInteger;
