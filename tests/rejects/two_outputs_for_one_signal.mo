// code: R077
// line: 16
// hint: one output drives a signal
block Source
  output Real y = 1;
end Source;
block Sink
  input Real u;
end Sink;
model M
  Source a;
  Source b;
  Sink c;
equation
  connect(a.y, c.u);
  connect(b.y, c.u);
end M;
