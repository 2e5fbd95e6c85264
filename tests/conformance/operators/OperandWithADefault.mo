// section: 14.5
// refuse: R079 5
operator record C
  Real a;
  encapsulated operator function '*'
    import C;
    input C x;
    input Real k = 2;
    output C z;
  algorithm
    z.a := k*x.a;
  end '*';
end C;
model OperandWithADefault
  C c = C(1)*3;
end OperandWithADefault;
