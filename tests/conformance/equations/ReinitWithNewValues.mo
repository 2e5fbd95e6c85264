// section: 8.3.6
// value: x = 10
model ReinitWithNewValues
  Real x(start = 1, fixed = true), z;
  Real k(start = 0, fixed = true);
equation
  der(x) = 0;
  z = k + x;
  when time > 0.5 then
    k = 4;
    reinit(x, 2*z);
  end when;
end ReinitWithNewValues;
