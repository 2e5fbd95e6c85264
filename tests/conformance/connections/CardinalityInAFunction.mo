// section: 3.7.4.3
// refuse: R002 8
model CardinalityInAFunction
  function f
    input Real x;
    output Real y;
  algorithm
    y := cardinality(x);
  end f;
  Real z = f(time);
end CardinalityInAFunction;
