// section: 4.9.5
// refuse: R025 11
model NumberForAnEnumeration
  type E = enumeration(a, b);
  function f
    input E x;
    output Real y;
  algorithm
    y := if x == E.a then 1 else 2;
  end f;
  Real z = f(1);
end NumberForAnEnumeration;
