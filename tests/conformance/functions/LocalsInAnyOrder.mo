// section: 12.4.4
// value: y = 12
model LocalsInAnyOrder "bindings of locals in any order"
  function f
    input Real x;
    output Real y;
  protected
    Real b = 2*a;
    Real a = 3*x;
  algorithm
    y := b;
  end f;
  Real y = f(2);
end LocalsInAnyOrder;
