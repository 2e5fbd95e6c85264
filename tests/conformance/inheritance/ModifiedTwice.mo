// section: 7.2.2
// refuse: R030 7
model ModifiedTwice
  model A
    Real x;
  end A;
  A a(x=2, x=3);
end ModifiedTwice;
