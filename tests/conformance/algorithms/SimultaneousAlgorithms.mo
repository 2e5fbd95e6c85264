// section: 11.2.7
// value: y3 = 10
model SimultaneousAlgorithms
  Real y1(start = 0, fixed = true), y2, y3(start = 0, fixed = true), y4;
algorithm
  when time > 0.5 then
    y1 := 3;
  end when;
equation
  y2 = 2*y4;
  y4 = y1 + time;
algorithm
  when time > 0.5 then
    y3 := y1 + y2;
  end when;
end SimultaneousAlgorithms;
