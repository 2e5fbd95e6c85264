// section: 12.4.2
// value: z at 0 = 1.1447142425533319, z = 1.2599210498948732, known = 1.5874010519681994
model FunctionAtRunTime "The function that looks for a root has a loop of unknown length, and stays one"
  partial function F
    input Real x;
    output Real y;
  end F;
  record Coefficients
    Real c[2];
    Integer n;
  end Coefficients;
  function polynomial
    extends F;
    input Coefficients r;
    input Real s[:];
  algorithm
    y := r.c[1]*x^r.n + r.c[2]*sum(s);
  end polynomial;
  function newton
    input F f;
    input Real x0;
    output Real x = x0;
    output Real steps = 0;
  protected
    Real d = 1;
  algorithm
    while abs(d) > 1e-11 and steps < 50 loop
      d := f(x)/((f(x + 1e-6) - f(x - 1e-6))/2e-6);
      x := x - d;
      steps := steps + 1;
    end while;
  end newton;
  parameter Real a = 2;
  Real z, steps;
  Real known = newton(function polynomial(r = Coefficients({1, -2}, 3), s = {2}), 1);
equation
  (z, steps) = newton(function polynomial(r = Coefficients({a, -1}, 3), s = {1, time, 2}), 1);
end FunctionAtRunTime;
