// section: 4.9.5
// refuse: R025 5
model EnumerationForReal
  type E = enumeration(a, b);
  parameter Real x = E.b;
end EnumerationForReal;
