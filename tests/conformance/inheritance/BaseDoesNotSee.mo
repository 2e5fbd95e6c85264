// section: 5.6.1
// refuse: R002 5
model BaseDoesNotSee
  model A
    Real x = y;
  end A;
  extends A;
  Real y = 1;
end BaseDoesNotSee;
