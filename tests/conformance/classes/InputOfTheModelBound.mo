// section: 4.4.2.2
// value: y = 6
model InputOfTheModelBound "an input of the model itself that a declaration gives its value"
  input Real u = 2;
  output Real y = 3*u;
end InputOfTheModelBound;
