// section: 4.9.5
// refuse: R025 11
model EnumerationForReal
  type E = enumeration(a, b);
  function f
    input Real u;
    output Real y;
  algorithm
    y := u;
  end f;
  Real y = f(E.b);
end EnumerationForReal;
