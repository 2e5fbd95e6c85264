// section: 12.4.2.1
// value: y = 7
model FunctionWithInputsBound
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function line
    extends Shape;
    input Real slope;
    input Real offset = 1;
  algorithm
    y := slope*u + offset;
  end line;
  function at2
    input Shape f;
    output Real y;
  algorithm
    y := f(2);
  end at2;
  Real y = at2(function line(slope=3*time));
end FunctionWithInputsBound;
