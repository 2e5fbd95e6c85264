// section: 8.3.5
// value: x = 1.6
model DiscreteInADerivative
  Real x(start=0, fixed=true);
  discrete Real slope(start=1, fixed=true);
equation
  der(x) = slope;
algorithm
  when time >= 0.4 then
    slope := 2;
  end when;
end DiscreteInADerivative;
