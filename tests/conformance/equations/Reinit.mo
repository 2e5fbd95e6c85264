// section: 8.3.6
// value: x at 0.5 = 0.5, x = 0.7
model Reinit "x starts again at -0.1 when it reaches 0.8"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  when x >= 0.8 then
    reinit(x, 0.5);
  end when;
end Reinit;
