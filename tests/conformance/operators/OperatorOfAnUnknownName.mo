// section: 14.1
// refuse: R070 5
operator record C
  Real a;
  encapsulated operator function '%'
    import C;
    input C x;
    input C y;
    output C z;
  algorithm
    z.a := x.a + y.a;
  end '%';
end C;
model OperatorOfAnUnknownName
  C c = C(1);
end OperatorOfAnUnknownName;
