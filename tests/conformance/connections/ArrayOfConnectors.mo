// section: 9.3
// value: r[1].f.x = 0.5, src.y[2] = 2
model ArrayOfConnectors "arrays of connectors of one size"
  connector F
    Real x;
    flow Real q;
  end F;
  model R
    F f;
  equation
    f.q = 2*f.x;
  end R;
  model S
    F f[2];
    Real y[2] = {1, 2}*time;
  equation
    f.q = -y;
  end S;
  R r[2];
  S src;
equation
  connect(src.f, r.f);
end ArrayOfConnectors;
