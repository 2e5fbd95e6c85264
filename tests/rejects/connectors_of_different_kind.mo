// code: R060
// line: 22
// hint: same kind
connector Pin
  Real v;
  flow Real i;
end Pin;
connector Flange
  Real phi;
  flow Real tau;
end Flange;
model Part
  Pin p;
  Flange f;
equation
  p.v = time;
  f.phi = time;
end Part;
model M
  Part a, b;
equation
  connect(a.p, b.f);
end M;
