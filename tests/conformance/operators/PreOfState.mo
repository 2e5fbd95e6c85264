// section: 3.7.5
// refuse: R052 5
model PreOfState
  Real x(start=0, fixed=true);
  Real y = pre(x);
equation
  der(x) = 1;
end PreOfState;
