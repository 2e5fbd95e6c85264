// section: 7.3
// value: v.a[2].x = 2
model SizeKept
  model A
    parameter Real x = 1;
  end A;
  model B
    extends A(x=2);
  end B;
  model U
    replaceable A a[2];
  end U;
  U v(redeclare B a);
end SizeKept;
