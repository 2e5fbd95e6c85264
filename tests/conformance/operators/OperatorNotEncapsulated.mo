// section: 14.1
// refuse: R070 6
model OperatorNotEncapsulated "an operator function that is not encapsulated"
  operator record C
    Real a;
    operator function '+'
      input C x;
      input C y;
      output C z = C(x.a + y.a);
    algorithm
    end '+';
  end C;
  C c = C(1) + C(2);
end OperatorNotEncapsulated;
