// section: 12.2
// refuse: R066 7
model PublicParameter
  function f
    input Real a;
    output Real y;
    parameter Real z = 1;
  algorithm
    y := a + z;
  end f;
  Real x = f(time);
end PublicParameter;
