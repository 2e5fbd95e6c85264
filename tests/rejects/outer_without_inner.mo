// code: R013
// line: 8
// hint: inner World world
model World
  parameter Real g = 9.81;
end World;
model M
  outer World world;
  Real x;
equation
  x = world.g;
end M;
