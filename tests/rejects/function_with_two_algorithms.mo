// code: R066
// line: 10
// hint: one algorithm section
model M
  function f
    input Real u;
    output Real y;
  algorithm
    y := u;
  algorithm
    y := 2*y;
  end f;
  Real x = f(time);
end M;
