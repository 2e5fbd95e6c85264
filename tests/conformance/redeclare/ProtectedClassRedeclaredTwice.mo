// section: 7.3
// refuse: R037 20
model A
  C1 c;
protected
  replaceable model C1
    Real x = 1;
  end C1;
end A;
model B
  model C2
    Real x = 2;
  end C2;
  extends A(redeclare replaceable model C1 = C2);
end B;
model C3
  Real x = 3;
end C3;
model ProtectedClassRedeclaredTwice
  B b(redeclare model C1 = C3);
end ProtectedClassRedeclaredTwice;
