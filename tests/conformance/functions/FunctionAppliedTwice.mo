// section: 12.4.2
// value: y = 8
model FunctionAppliedTwice
  partial function F
    input Real u;
    output Real y;
  end F;
  function apply
    input F f;
    input Real u;
    output Real y;
  algorithm
    y := f(f(u));
  end apply;
  function double
    extends F;
  algorithm
    y := 2*u;
  end double;
  Real y = apply(double, 2);
end FunctionAppliedTwice;
