// section: 12.4.2
// value: y = 0.3333333333
model FunctionAsInput "a quadrature of a function that is handed in"
  partial function F
    input Real x;
    output Real y;
  end F;
  function sq
    extends F;
  algorithm
    y := x^2;
  end sq;
  function simpson
    input F f;
    input Real a, b;
    output Real y = (b - a)/6*(f(a) + 4*f((a + b)/2) + f(b));
  end simpson;
  Real y = simpson(sq, 0, time);
end FunctionAsInput;
