// section: 12.2
// refuse: U002 15
model UnitByExtends "two known results of different units"
  function f
    input Real x;
    output Real y(unit="m");
  algorithm
    y := x;
  end f;
  function g
    extends f(y(unit="s"));
  end g;
  Real v(unit="m");
equation
  v = f(2) + g(3);
  annotation(experiment(StopTime=1));
end UnitByExtends;
