// section: 12.4.2
// value: z at 0 = 0.9142135623730951, z = 1.2320508075688772
model FunctionHandedOnAtRunTime "A function bound to a function, and handed on to another that runs at run time"
  partial function F
    input Real x;
    output Real y;
  end F;
  function square
    extends F;
    input Real a;
  algorithm
    y := x^2 - a;
  end square;
  function shifted
    extends F;
    input F f;
    input Real by;
  algorithm
    y := f(x + by);
  end shifted;
  function between "Whether f changes its sign between x and x + h"
    input F f;
    input Real x;
    input Real h;
    output Boolean found;
  protected
    Integer n = 0;
  algorithm
    while n < 3 and h > 0 loop
      n := n + 1;
    end while;
    found := f(x)*f(x + h) <= 0;
  end between;
  function bisection
    input F f;
    output Real x = 0;
  protected
    Real h = 4;
  algorithm
    while h > 1e-12 loop
      h := h/2;
      x := if between(f, x, h) then x else x + h;
    end while;
  end bisection;
  Real z = bisection(function shifted(f = function square(a = 2 + time), by = 0.5));
end FunctionHandedOnAtRunTime;
