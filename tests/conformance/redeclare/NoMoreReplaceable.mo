// section: 7.3
// refuse: R033 16
model NoMoreReplaceable
  model A
    parameter Real x = 1;
  end A;
  model B
    extends A(x=2);
  end B;
  model U
    replaceable A a;
  end U;
  model V
    extends U(redeclare B a);
  end V;
  V v(redeclare A a);
end NoMoreReplaceable;
