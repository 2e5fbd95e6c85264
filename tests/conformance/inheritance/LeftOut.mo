// section: 7.4
// value: b.x = 1, b.p.y = 3
model LeftOut
  model P
    Real y = 2;
  end P;
  model Q
    Real y = 3;
  end Q;
  model A
    Real x = 1;
    P p;
  end A;
  model B
    extends A(break p);
    Q p;
  end B;
  B b;
end LeftOut;
