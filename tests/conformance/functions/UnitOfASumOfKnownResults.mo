// section: 19.1
// refuse: U001 12
model UnitOfASumOfKnownResults "a sum of known results"
  function f
    input Real x;
    output Real y(unit="m");
  algorithm
    y := x;
  end f;
  Real v(unit="s");
equation
  v = f(2) + f(3);
end UnitOfASumOfKnownResults;
