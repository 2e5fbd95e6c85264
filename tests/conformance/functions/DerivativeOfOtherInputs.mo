// section: 12.7.1
// refuse: R050 9
model DerivativeOfOtherInputs
  function f
    input Real x;
    output Real y;
  algorithm
    y := x^2;
    annotation(derivative=df);
  end f;
  function df
    input Real x;
    output Real dy;
  algorithm
    dy := 2*x;
  end df;
  Real y = f(time);
end DerivativeOfOtherInputs;
