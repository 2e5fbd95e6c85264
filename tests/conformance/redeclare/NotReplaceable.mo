// section: 7.3
// refuse: R033 10
model NotReplaceable
  model A
    Real x = 1;
  end A;
  model H
    A a;
  end H;
  H h(redeclare A a);
end NotReplaceable;
