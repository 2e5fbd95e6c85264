// section: 12.2
// refuse: R024 8
model AttributeOfAnotherType
  function f
    input Real u(max=limit);
    input Real limit = 2;
  protected
    Real x(min="a");
  public
    output Real y;
  algorithm
    x := u;
    y := x;
  end f;
  Real y = f(time);
end AttributeOfAnotherType;
