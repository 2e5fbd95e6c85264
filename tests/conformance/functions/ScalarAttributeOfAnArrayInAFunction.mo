// section: 7.2.5
// refuse: R036 6
model ScalarAttributeOfAnArrayInAFunction
  function f
    input Real x;
    output Real y[2](start=1);
  algorithm
    y := {x, x};
  end f;
  Real z[2] = f(time);
end ScalarAttributeOfAnArrayInAFunction;
