// section: 7.1.3
// refuse: R071 11
model ModelFromFunction
  function f
    input Real x;
    output Real y;
  algorithm
    y := x;
  end f;
  model B
    extends f;
  end B;
  B b;
end ModelFromFunction;
