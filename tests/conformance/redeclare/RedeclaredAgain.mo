// section: 7.3
// value: y = 3
model RedeclaredAgain
  model A
    parameter Real x = 1;
  end A;
  model B
    extends A(x=2);
  end B;
  model C
    extends A(x=3);
  end C;
  model U
    replaceable A a;
  end U;
  model V
    extends U(redeclare replaceable B a);
  end V;
  V v(redeclare C a);
  Real y = v.a.x;
end RedeclaredAgain;
