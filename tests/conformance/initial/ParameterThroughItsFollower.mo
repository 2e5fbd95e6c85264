// section: 8.6
// value: q = 0.3333333333333
model ParameterThroughItsFollower
  parameter Real p = 2 * q;
  parameter Real q(fixed = false, start = 0.5);
initial equation
  q = 1 - p;
end ParameterThroughItsFollower;
