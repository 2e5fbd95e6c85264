// section: 6.4
// refuse: R034 15
model ConditionalWhereItIsNot "a conditional component of the constraining class"
  model A
    parameter Boolean c = true;
    Real x = 1;
  end A;
  model B
    parameter Boolean c = true;
    Real x = 1 if c;
  end B;
  model C
    replaceable A a;
  end C;
  C c(redeclare B a);
end ConditionalWhereItIsNot;
