// section: 4.8
// refuse: R078 8
model A
  input Real u;
  Real y = u;
end A;
model InputOfAComponentUnbound
  A a;
equation
  a.u = 2;
end InputOfAComponentUnbound;
