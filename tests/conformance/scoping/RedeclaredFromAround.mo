// section: 5.3
// value: b.a.p = 3
model RedeclaredFromAround
  model C
    parameter Real p = 1;
  end C;
  model B
    A a;
    replaceable model A = C;
  end B;
  B b(redeclare model A = D(p = 3));
  model D
    extends C;
  end D;
end RedeclaredFromAround;
