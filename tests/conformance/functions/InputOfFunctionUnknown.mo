// section: 12.4.2.1
// refuse: R050 19
model InputOfFunctionUnknown
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function line
    extends Shape;
  algorithm
    y := u;
  end line;
  function at2
    input Shape f;
    output Real y;
  algorithm
    y := f(2);
  end at2;
  Real y = at2(function line(slope=3));
end InputOfFunctionUnknown;
