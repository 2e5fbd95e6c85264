// section: 14.3
// refuse: R079 16
operator record C
  Real a;
  encapsulated operator function 'constructor'
    import C;
    import D;
    input D d;
    output C c;
  algorithm
    c.a := d.b;
  end 'constructor';
end C;
operator record D
  Real b;
  encapsulated operator function 'constructor'
    import C;
    import D;
    input C c;
    output D d;
  algorithm
    d.b := c.a;
  end 'constructor';
end D;
model MadeOfEachOther
  C c(a = 1);
  D d = D(c);
end MadeOfEachOther;
