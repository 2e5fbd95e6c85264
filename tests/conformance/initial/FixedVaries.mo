// section: 4.8.1
// refuse: R055 5
model FixedVaries
  parameter Real p = 1;
  Real x(start=1, fixed=p > time);
equation
  der(x) = 1;
end FixedVaries;
