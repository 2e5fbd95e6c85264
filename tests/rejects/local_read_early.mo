// code: F033
// line: 6
// hint: give it a value first
model LocalReadEarly
  function f
    input Real x; output Real y;
  protected
    Real z;
  algorithm
    y := z + x;
  end f;
  Real x = f(time);
end LocalReadEarly;
