// section: 12.4.2
// value: y = 32
model FunctionHandedOn
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function double
    extends Shape;
  algorithm
    y := 2*u;
  end double;
  function twice
    input Shape f;
    input Real u;
    output Real y;
  algorithm
    y := f(f(u));
  end twice;
  function fourTimes
    input Shape f;
    input Real u;
    output Real y;
  algorithm
    y := twice(f, twice(f, u));
  end fourTimes;
  Real y = fourTimes(double, 2*time);
end FunctionHandedOn;
