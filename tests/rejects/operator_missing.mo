// code: R079
// line: 10
// hint: operator '+'
model M
  operator record C
    Real re;
    Real im;
  end C;
  C a = C(1, 2), b = C(3, 4);
  C c = a + b;
end M;
