// section: 8.3.7
// value: x = 1
model AssertionWarning "a violated assertion of level warning does not end the run"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  assert(x < 0.5, "x is " + String(x), AssertionLevel.warning);
end AssertionWarning;
