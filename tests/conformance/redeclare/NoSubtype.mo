// section: 7.3.2
// refuse: R034 14
model NoSubtype
  model A
    Real x = 1;
    Real y = 1;
  end A;
  model B
    Real x = 2;
  end B;
  model H
    replaceable A a;
  end H;
  H h(redeclare B a);
end NoSubtype;
