// section: 12.2
// refuse: R066 7
model ProtectedInput
  function f
    output Real y;
  protected
    input Real x;
  algorithm
    y := x;
  end f;
  Real y = f(2);
end ProtectedInput;
