// section: 7.2.4
// value: c.b.k = 3
model OuterModifierWins
  model A
    parameter Real k = 1;
  end A;
  model B
    extends A(k=2);
  end B;
  model C
    B b(k=3);
  end C;
  C c;
end OuterModifierWins;
