// section: 7.3.2
// value: h.b.x = 3
model OuterOverConstraint
  model A
    Real x = 0;
  end A;
  model H
    replaceable A b constrainedby A(x=2);
  end H;
  H h(b(x=3));
end OuterOverConstraint;
