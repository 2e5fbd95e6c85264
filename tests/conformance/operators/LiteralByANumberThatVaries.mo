// section: 4.9.5.3
// value: d at 0.1 = 1, d = 3, y at 0.1 = 30, y = 20, a = 2, b = 3
model LiteralByANumberThatVaries
  type E = enumeration(one, two, three);
  type Again = E;
  type Extended
    extends E;
  end Extended;
  Integer k = 1 + integer(2.5*time);
  E d = E(k);
  Real x[E] = {30, 10, 20};
  Real y = x[d];
  Again a = Again(2);
  Extended b = Extended.three;
end LiteralByANumberThatVaries;
