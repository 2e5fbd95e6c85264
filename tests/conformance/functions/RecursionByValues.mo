// section: 12.4
// value: y = 0.841470985, z = 8, g = 4
model RecursionByValues "how far a recursion goes may be a matter of values, or known"
  partial function Scalar
    input Real u;
    output Real y;
  end Scalar;
  function integral "adaptive Simpson"
    input Scalar f;
    input Real a, b;
    input Real tol=1e-10;
    input Integer depth=0;
    output Real I;
  protected
    Real c=(a + b)/2, S1, S2, l, r;
  algorithm
    S1 := (b - a)/6*(f(a) + 4*f(c) + f(b));
    l := (c - a)/6*(f(a) + 4*f((a + c)/2) + f(c));
    r := (b - c)/6*(f(c) + 4*f((b + c)/2) + f(b));
    S2 := l + r;
    if abs(S2 - S1) < 15*tol or depth > 20 then
      I := S2 + (S2 - S1)/15;
    else
      I := integral(f, a, c, tol/2, depth + 1) + integral(f, c, b, tol/2, depth + 1);
    end if;
  end integral;
  function wave
    extends Scalar;
    input Real k;
  algorithm
    y := cos(k*u);
  end wave;
  function power
    input Real x;
    input Integer n;
    output Real y;
  algorithm
    y := if n == 0 then 1 else x*power(x, n - 1);
  end power;
  function even
    input Real x;
    output Real y;
  algorithm
    y := if x < 1 then x else odd(x - 1);
  end even;
  function odd
    input Real x;
    output Real y;
  algorithm
    y := if x < 1 then x + 4 else even(x - 1);
  end odd;
  Real y=integral(function wave(k=time), 0, 1);
  Real z=power(2*time, 3);
  Real g=even(5*time);
end RecursionByValues;
