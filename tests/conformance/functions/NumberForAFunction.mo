// section: 12.4.2
// refuse: R062 14
model NumberForAFunction
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function at2
    input Shape f;
    output Real y;
  algorithm
    y := f(2);
  end at2;
  Real y = at2(3);
end NumberForAFunction;
