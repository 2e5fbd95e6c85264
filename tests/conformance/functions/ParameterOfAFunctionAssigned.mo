// section: 12.4.4
// refuse: R058 10
model ParameterOfAFunctionAssigned "a parameter of a function is not assigned"
  function f
    input Real x;
    output Real y;
  protected
    parameter Real c = 2;
  algorithm
    c := x;
    y := c;
  end f;
  Real z = f(2);
end ParameterOfAFunctionAssigned;
