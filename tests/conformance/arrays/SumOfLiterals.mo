// section: 10.3.4
// refuse: R025 5
model SumOfLiterals
  type E = enumeration(a, b);
  Integer k = sum({E.a, E.b});
end SumOfLiterals;
