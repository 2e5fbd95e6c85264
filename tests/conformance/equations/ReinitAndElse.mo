// section: 8.3.6
// value: x = 5.3
model ReinitAndElse "of one when-clause: the first that becomes true"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  when time > 0.5 then
    reinit(x, 0);
  elsewhen time > 0.7 then
    reinit(x, 5);
  end when;
end ReinitAndElse;
