// section: 3.5
// refuse: R024 7
model TwoStringValues
  String s = "a";
  Real x = 1;
equation
  s = "b";
end TwoStringValues;
