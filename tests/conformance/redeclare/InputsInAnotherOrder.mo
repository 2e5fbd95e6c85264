// section: 6.6
// refuse: R034 22
model InputsInAnotherOrder
  function f
    input Real x;
    input Real w;
    output Real y;
  algorithm
    y := x - w;
  end f;
  function g
    input Real w;
    input Real x;
    output Real y;
  algorithm
    y := x - w;
  end g;
  model U
    replaceable function h = f;
    Real z = h(1, 2);
  end U;
  U u(redeclare function h = g);
end InputsInAnotherOrder;
