// section: 7.3.2
// value: h.b.x = 2, h.b.z = 5
model ConstraintHoldsAfterwards
  model A
    Real x = 0;
  end A;
  model C
    Real x = 1;
    Real z = 5;
  end C;
  model H
    replaceable A b constrainedby A(x=2);
  end H;
  H h(redeclare C b);
end ConstraintHoldsAfterwards;
