// section: 12.4.3
// value: c = 30, d = 10
model ResultLeftOut
  function f
    input Real a;
    output Real x, y, z;
  algorithm
    x := a;
    y := 2*a;
    z := 3*a;
  end f;
  Real c, d;
equation
  (, , c) = f(10);
  (d, ) = f(10);
end ResultLeftOut;
