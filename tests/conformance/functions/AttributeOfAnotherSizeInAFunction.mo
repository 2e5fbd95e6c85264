// section: 10.1
// refuse: R036 6
model AttributeOfAnotherSizeInAFunction
  function f
    input Real x;
    output Real y[2](start={1, 2, 3});
  algorithm
    y := {x, x};
  end f;
  Real z[2] = f(time);
end AttributeOfAnotherSizeInAFunction;
