// section: 3.7.3
// value: n = 7
model AtTheEnd
  Real x(start = 1, fixed = true);
  Integer n(start = 0, fixed = true);
equation
  der(x) = -1;
  when x < 0.5 then
    reinit(x, 1);
  end when;
  when terminal() then
    n = 7;
  end when;
end AtTheEnd;
