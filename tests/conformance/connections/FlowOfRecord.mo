// section: 4.4.2.2
// value: c.r.x = 0
model FlowOfRecord
  record R
    Real x;
  end R;
  connector C
    Real e;
    flow R r;
  end C;
  model M
    C c;
  equation
    c.e = 1;
  end M;
  M m;
  C c;
equation
  connect(m.c, c);
end FlowOfRecord;
