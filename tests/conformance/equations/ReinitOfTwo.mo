// section: 8.3.6
// value: x = 5.5, y = 0.5
model ReinitOfTwo "two states trade what they held before"
  Real x(start=0, fixed=true), y(start=5, fixed=true);
equation
  der(x) = 1;
  der(y) = 1;
  when time > 0.5 then
    reinit(x, pre(y) - 0.5);
    reinit(y, pre(x) - 0.5);
  end when;
end ReinitOfTwo;
