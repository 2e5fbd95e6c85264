// section: 10.4.3
// refuse: R025 8
model RangeOfTwoEnumerations
  type E = enumeration(a, b);
  type F = enumeration(a, b);
  Real x;
equation
  x = sum(Integer(e) for e in E.a:F.b);
end RangeOfTwoEnumerations;
