// section: 12.4.2
// value: x = 9, y = 4
model FunctionByDefault "An input that is a function may have a default, as any other"
  partial function F
    input Real u;
    output Real y;
  end F;
  function square
    extends F;
  algorithm
    y := u^2;
  end square;
  function apply
    input F f = square;
    input Real a = 3;
    output Real y;
  algorithm
    y := f(a);
  end apply;
  Real x = apply();
  Real y = apply(a = 2*time);
end FunctionByDefault;
