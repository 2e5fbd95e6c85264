// section: 11.2.2.1
// value: x[1] = 1, x[3] = 3
model ImpliedRangeOfEnumeration
  type Colour = enumeration(red, green, blue);
  Real x[Colour];
equation
  for c loop
    x[c] = Integer(c);
  end for;
end ImpliedRangeOfEnumeration;
