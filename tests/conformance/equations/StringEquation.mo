// section: 3.5
// value: n = 1
model StringEquation
  String s;
  Integer n = if s == "a b" then 1 else 0;
equation
  s = "a" + " b";
end StringEquation;
