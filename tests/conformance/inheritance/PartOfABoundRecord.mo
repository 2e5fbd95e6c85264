// section: 7.2.3
// refuse: R030 11
record A
  parameter Real x;
  parameter Real y;
end A;
model B
  parameter A a = A(2, 3);
end B;
model PartOfABoundRecord
  B b1(a(x = 4));
end PartOfABoundRecord;
