// section: 12.2
// refuse: R066 8
model OuterInside
  function f
    input Real x;
    output Real y;
  protected
    outer Real k;
  algorithm
    y := k*x;
  end f;
  inner Real k = 2;
  Real y = f(1);
end OuterInside;
