// section: 6.7
// refuse: R025 6
model AlternativesOfTwoEnumerations "alternatives are type compatible, whichever is chosen"
  type E = enumeration(a, b);
  type F = enumeration(a, c);
  E e = if true then E.a else F.a;
end AlternativesOfTwoEnumerations;
