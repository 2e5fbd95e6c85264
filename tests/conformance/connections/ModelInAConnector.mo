// section: 4.7
// refuse: R070 9
model ModelInAConnector
  model M
    Real x = 1;
  end M;
  connector C
    Real p;
    M m;
    flow Real f;
  end C;
  C c;
equation
  c.p = 1;
end ModelInAConnector;
