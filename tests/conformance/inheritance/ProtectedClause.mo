// section: 7.1.2
// refuse: R017 12
model ProtectedClause
  model A
    Real x = 1;
  end A;
  model B
  protected
    extends A;
  end B;
  B b;
  Real y = b.x;
end ProtectedClause;
