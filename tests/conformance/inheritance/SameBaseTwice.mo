// section: 7.1
// value: x = 1
model SameBaseTwice
  model A
    Real x = 1;
  end A;
  model B
    extends A;
  end B;
  model C
    extends A;
  end C;
  extends B;
  extends C;
end SameBaseTwice;
