// section: 12.3
// refuse: R082 14
model ImpureInAPureFunction
  impure function g
    input Real x;
    output Real y;
  algorithm
    y := x;
  end g;
  function f
    input Real x;
    output Real y;
  algorithm
    y := 2*g(x);
  end f;
  discrete Real y;
equation
  when initial() then
    y = f(time);
  end when;
end ImpureInAPureFunction;
