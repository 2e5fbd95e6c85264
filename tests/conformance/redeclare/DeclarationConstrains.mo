// section: 7.3.2
// value: a.b.x = 5, a.b.p = 4
model B
  parameter Real x = 1;
end B;
model C
  extends B;
  parameter Real p = 3;
end C;
model A
  replaceable B b(x = 5);
end A;
model DeclarationConstrains
  A a(redeclare C b(p = 4));
end DeclarationConstrains;
