// section: 8.6
// refuse: S020 6
model TooManyFixed
  Real x(start=1, fixed=true);
initial equation
  x = 2;
  der(x) = 0;
equation
  der(x) = -x;
end TooManyFixed;
