// section: 7.3
// refuse: R037 12
model ProtectedClass
  model C
    Real x = 3;
  end C;
  model A
  protected
    replaceable model B = C;
    B b;
  end A;
  A a(redeclare model B = C);
end ProtectedClass;
