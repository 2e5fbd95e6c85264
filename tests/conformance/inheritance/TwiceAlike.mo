// section: 7.1
// value: x = 1
model TwiceAlike
  model A
    Real x = 1;
  end A;
  model B
    Real x = 1;
  end B;
  extends A;
  extends B;
end TwiceAlike;
