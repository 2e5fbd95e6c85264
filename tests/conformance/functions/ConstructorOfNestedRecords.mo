// section: 12.6
// value: c.b.x = 5, c.b.y[2] = 5, d.c.b.x = 7, d.c.z = 9, w = 2
package Nested
  record B
    parameter Real x = 2;
    parameter Real y[2] = {1, x};
  end B;
  record C
    B b(x = 5);
    Real z = 3;
  end C;
  record D
    C c(b(x = 7), z = 9);
    Real q = 1;
  end D;
  function f
    output Real y;
  protected
    B b;
  algorithm
    y := b.y[2];
  end f;
end Nested;
model ConstructorOfNestedRecords "A field that is a record has the values that its declaration gives its fields"
  Nested.C c = Nested.C();
  Nested.D d = Nested.D(q = 4);
  Real w = Nested.f();
end ConstructorOfNestedRecords;
