// section: 7.2
// value: c.b.a.x = 42
model ModifierOfModifier "the outermost of three modifiers holds"
  model A
    parameter Real x = 1;
    Real y = time;
  end A;
  model B
    A a(x=2);
  end B;
  model C
    B b(a(x=3));
  end C;
  C c(b(a(x=42)));
end ModifierOfModifier;
