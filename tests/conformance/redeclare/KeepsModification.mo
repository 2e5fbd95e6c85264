// section: 7.3
// value: e.a.x = 7, e.a.y = 8
model KeepsModification
  model A
    Real x = 1;
    Real y = 2;
  end A;
  model C
    replaceable A a;
  end C;
  model D
    extends C(a(x=7));
  end D;
  model E
    extends D(redeclare A a(y=8));
  end E;
  E e;
end KeepsModification;
