// section: 7.3.2
// refuse: R034 15
model ClassNoSubtype
  model A
    Real x = 1;
    Real y = 1;
  end A;
  model B
    Real x = 2;
  end B;
  model H
    replaceable model T = A;
    T t;
  end H;
  H h(redeclare model T = B);
end ClassNoSubtype;
