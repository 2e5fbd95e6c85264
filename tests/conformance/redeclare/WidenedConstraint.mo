// section: 7.3.2
// refuse: R034 18
model A
  Real x = 1.0;
end A;
model B
  Real x = 2.0;
  Real y = 2.0;
end B;
model C
  Real x = 3.0;
  Real y = 5.0;
end C;
model D
  replaceable B b constrainedby B;
end D;
model E
  extends D(replaceable C b constrainedby A);
end E;
model WidenedConstraint
  E e;
end WidenedConstraint;
