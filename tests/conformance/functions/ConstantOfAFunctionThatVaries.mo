// section: 12.2
// refuse: R055 8
model ConstantOfAFunctionThatVaries "a function with a constant that varies by an input is local, a constant with an input is not"
  function f
    input Real x;
    output Real y;
  protected
    constant Real c = x;
  algorithm
    y := c;
  end f;
  Real z = f(time);
end ConstantOfAFunctionThatVaries;
