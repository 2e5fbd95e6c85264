// section: 8.3.5
// refuse: S013 8
model CircleThroughAnEquation
  Real x, y(start = 1, fixed = true);
equation
  x = 5 - y;
  when time > 0.5 then
    y = 7 - 2*x;
  end when;
end CircleThroughAnEquation;
