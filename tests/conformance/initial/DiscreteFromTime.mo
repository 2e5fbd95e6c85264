// section: 8.6
// value: n at 0.1 = 3, n = 4
model DiscreteFromTime
  Integer n;
  parameter Real offset = 3.5;
initial algorithm
  n := integer(time + offset);
equation
  when time > 0.5 then
    n = pre(n) + 1;
  end when;
end DiscreteFromTime;
