// section: 7.3
// value: m.b.y = 6
model FunctionOfAComponentInheritedTwice
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
  model A2
    extends A;
  end A2;
  model B
    extends A2;
    Real y = g(2);
  end B;
  model C
    parameter Real k = 3;
    B b(redeclare function g = f(k=k));
  end C;
  C m;
end FunctionOfAComponentInheritedTwice;
