// section: 12.4.2
// value: y = 9, z at 0.5 = 0.5
model FunctionAsArgument
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function square
    extends Shape;
  algorithm
    y := u^2;
  end square;
  function twice
    input Shape f;
    input Real u;
    output Real y;
  algorithm
    y := f(u) + f(u);
  end twice;
  Real y = twice(square, 1.5) + 4.5;
  Real z = twice(square, time);
end FunctionAsArgument;
