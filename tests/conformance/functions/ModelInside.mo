// section: 12.2
// refuse: R066 11
model ModelInside
  model M
    parameter Real m = 1;
  end M;
  function f
    input Real a;
    output Real b;
  protected
    M m;
  algorithm
    b := a + m.m;
  end f;
  Real x = f(2.0);
end ModelInside;
