// section: 7.3
// value: m.y = 6
model FunctionInheritedTwice
  partial function P
    input Real u;
    output Real y;
  end P;
  function f
    extends P;
    input Real k = 1;
  algorithm
    y := k*u;
  end f;
  partial model A
    replaceable function g = P;
  end A;
  model B
    extends A;
    Real y = g(2);
  end B;
  model C
    extends B;
  end C;
  C m(redeclare function g = f(k=3));
end FunctionInheritedTwice;
