// section: 7.4
// value: b.x = 1
model LeftOut
  model A
    Real x = 1;
    Real y = 2;
  end A;
  model B
    extends A(break y);
    Real y = 3;
  end B;
  B b;
end LeftOut;
