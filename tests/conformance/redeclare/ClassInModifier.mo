// section: 7.3
// value: a.x.y = 5, b.x.y = 2
model ClassInModifier
  model P
    Real y = 2;
  end P;
  model Q
    Real y = 5;
  end Q;
  model H
    replaceable model T = P;
    T x;
  end H;
  H a(redeclare model T = Q);
  H b;
end ClassInModifier;
