// section: 7.3
// refuse: R033 11
model ClassNotReplaceable
  model P
    Real y = 2;
  end P;
  model H
    model T = P;
    T x;
  end H;
  H h(redeclare model T = P);
end ClassNotReplaceable;
