// section: 7.3.2
// value: b.x = 2
model ConstraintHolds
  class A
    Real x;
  end A;
  class B
    Real x = 1;
  end B;
  replaceable B b constrainedby A(x=2);
end ConstraintHolds;
