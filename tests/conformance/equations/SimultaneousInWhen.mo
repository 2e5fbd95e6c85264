// section: 8.3.5
// value: y3 = 5.6983697704
model SimultaneousInWhen
  Real x = 3*time;
  Real y1(start = 0, fixed = true), y2, y3(start = 0, fixed = true);
equation
  when x > 2 then
    y3 = 2*x + y1 + y2;
    y1 = sin(x);
  end when;
  y2 = sin(y1);
end SimultaneousInWhen;
