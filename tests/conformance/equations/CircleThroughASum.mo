// section: 8.3.5
// refuse: S013 8
model CircleThroughASum
  Real x, y(start = 1, fixed = true);
equation
  x + y = 5;
  when time > 0.5 then
    y = 7 - 2*x;
  end when;
end CircleThroughASum;
