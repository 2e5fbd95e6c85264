// section: 9.2
// value: a.f.q = -3, x = 1.5
model ConnectorFlowSum3 "three flows add up to zero"
  connector F
    Real x;
    flow Real q;
  end F;
  model R
    F f;
  equation
    f.q = f.x;
  end R;
  model S
    F f;
  equation
    f.q = -3*time;
  end S;
  S a;
  R b, c;
  Real x = b.f.x;
equation
  connect(a.f, b.f);
  connect(b.f, c.f);
end ConnectorFlowSum3;
