// code: R015
// line: 8
// hint: extends it
partial model Shape
  Real x;
end Shape;
model M
  Shape shape;
end M;
