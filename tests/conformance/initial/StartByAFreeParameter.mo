// section: 8.6
// value: r at 0 = 2, r = 0.735758882, s at 0 = 5, t at 0 = 4, r0 = 2
model StartByAFreeParameter "a fixed start value is an equation of the initial system, whatever it is made of"
  parameter Real r0(fixed=false, start=1);
  parameter Real twice=2*r0;
  Real r(start=r0, fixed=true);
  Real s(start=twice + 1, fixed=true);
  Real t(start=twice);
initial equation
  r0^2 = 4;
equation
  der(r) = -r;
  der(s) = 0;
  t^2 = 4*twice;
end StartByAFreeParameter;
