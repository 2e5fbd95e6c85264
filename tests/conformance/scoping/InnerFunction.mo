// section: 5.4
// value: y = 6, z = 6
model InnerFunction "inner function by outer function"
  function base
    input Real u;
    output Real y = u;
  algorithm
  end base;
  model U
    outer function f = base;
    Real y = f(2*time);
  end U;
  model W
    inner function f = g;
    function g
      input Real u;
      output Real y = 3*u;
    algorithm
    end g;
    U u;
  end W;
  W w;
  Real y = w.u.y;
  Real z = y;
end InnerFunction;
