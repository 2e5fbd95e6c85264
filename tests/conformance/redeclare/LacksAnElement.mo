// section: 6.3
// refuse: R034 15
model LacksAnElement
  model A
    Real x = 1;
    replaceable model R = Q;
    R r;
  end A;
  model Q
    Real q = 2;
  end Q;
  model P
    Real p = 2;
  end P;
  A a(redeclare model R = P);
end LacksAnElement;
