// section: 5.4
// value: e.d.y = 1, f.d.y = 2
model InnerFunction
  partial function A
    input Real u;
    output Real y;
  end A;
  function B
    extends A;
  algorithm
    y := u;
  end B;
  function C
    extends A;
  algorithm
    y := u + 1;
  end C;
  model D
    outer function fc = A;
    Real y = fc(1);
  end D;
  model E
    inner function fc = B;
    D d;
  end E;
  model F
    inner function fc = C;
    D d;
  end F;
  E e;
  F f;
end InnerFunction;
