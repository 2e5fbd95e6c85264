// section: 10.3.4.1
// value: x = 2.5, x at 0.5 = 0.5
model SumOverAVaryingRangeInADerivative
  Real u[2] = {1, 3};
  Real x(start=0, fixed=true);
  Integer k = if time > 0.5 then 2 else 1;
equation
  der(x) = sum(u[i] for i in 1:k);
end SumOverAVaryingRangeInADerivative;
