// section: B.2.2
// refuse: P021 7
model ConstrainedWithoutReplaceable
  model A
    Real y = 1;
  end A;
  A a constrainedby A;
end ConstrainedWithoutReplaceable;
