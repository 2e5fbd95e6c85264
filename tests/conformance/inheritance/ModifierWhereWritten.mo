// section: 7.2.1
// value: b.a.k = 7
model ModifierWhereWritten
  model A
    parameter Real k = 1;
  end A;
  model B
    parameter Real k = 2;
    A a;
  end B;
  parameter Real k = 7;
  B b(a(k=k));
end ModifierWhereWritten;
