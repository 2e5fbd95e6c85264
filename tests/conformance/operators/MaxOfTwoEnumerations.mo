// section: 10.3.4
// refuse: R025 6
model MaxOfTwoEnumerations "two literals of different types have no order"
  type E = enumeration(a, b);
  type F = enumeration(a, c);
  Boolean x = max(E.a, F.c) == E.a;
end MaxOfTwoEnumerations;
