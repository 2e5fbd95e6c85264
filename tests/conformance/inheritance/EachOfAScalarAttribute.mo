// section: 7.2.5
// refuse: R038 4
model EachOfAScalarAttribute
  Real x(each start = 3, fixed = true);
equation
  der(x) = 1;
end EachOfAScalarAttribute;
