// section: 5.3.2, 7.3.2
// value: x = 14, z = 14, w = 12
model ThroughAComponentWithDefaults
  function f
    input Real u;
    input Real a = 1;
    input Real b = 0;
    output Real y = a*u + b;
  algorithm
  end f;
  model World
    parameter Real g = 9;
    parameter Real c = 2;
    replaceable function h = f(a=g, b=2*c);
    Real y = h(1.5);
  end World;
  World world(g=4, c=3);
  Real x = world.h(2);
  Real z = world.h(u=2);
  World other(redeclare function h = f(a=k));
  parameter Real k = 4;
  Real w = other.h(2);
end ThroughAComponentWithDefaults;
