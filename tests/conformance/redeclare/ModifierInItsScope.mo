// section: 7.3
// value: h.x.y = 9
model ModifierInItsScope
  model P
    parameter Real k = 1;
    Real y = k;
  end P;
  model H
    parameter Real k = 4;
    replaceable model T = P;
    T x;
  end H;
  parameter Real k = 9;
  H h(redeclare model T = P(k=k));
end ModifierInItsScope;
