// section: 3.7.4.3, 4.5
// value: n = 1, m = 0
model CardinalityOfAConditional "A connection to a component that is not there counts on neither side"
  connector Pin
    Real v;
    flow Real i;
  end Pin;
  model Ground
    Pin p;
  equation
    p.v = 0;
  end Ground;
  Ground here;
  Ground there if false;
  Pin a;
  Pin b;
  Integer n = cardinality(a);
  Integer m = cardinality(b);
equation
  connect(a, here.p);
  connect(a, there.p);
  connect(b, there.p);
  b.v = 1;
end CardinalityOfAConditional;
