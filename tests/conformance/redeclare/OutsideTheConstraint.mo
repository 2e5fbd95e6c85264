// section: 7.3.2
// refuse: R034 20
model OutsideTheConstraint
  partial model I
    Real x;
    Real y = 2;
  end I;
  model M
    replaceable model A = B constrainedby I;
    A a;
  end M;
  model B
    extends I;
  equation
    x = 1;
  end B;
  model C
    Real x = 2;
  end C;
  M m(redeclare model A = C);
end OutsideTheConstraint;
