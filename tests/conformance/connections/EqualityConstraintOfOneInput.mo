// section: 9.4
// refuse: R080 6
model EqualityConstraintOfOneInput "equalityConstraint needs its inputs and its output"
  record R
    Real a;
    function equalityConstraint
      input R x;
      output Real r[1];
    algorithm
      r := {x.a};
    end equalityConstraint;
  end R;
  connector C
    R r;
    Real p;
    flow Real f;
  end C;
  model A
    C c;
  equation
    Connections.root(c.r);
    c.r = R(1);
    c.p = 1;
  end A;
  model B
    C c;
  equation
    Connections.root(c.r);
    c.r = R(1);
    c.f = 0;
  end B;
  A a;
  B b;
equation
  connect(a.c, b.c);
end EqualityConstraintOfOneInput;
