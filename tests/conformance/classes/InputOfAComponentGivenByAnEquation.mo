// section: 4.8
// value: a.y = 2
model A
  input Real u;
  Real y = u;
end A;
model InputOfAComponentGivenByAnEquation
  A a;
equation
  a.u = 2;
end InputOfAComponentGivenByAnEquation;
