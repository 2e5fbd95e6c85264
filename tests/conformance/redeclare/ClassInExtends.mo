// section: 7.3
// value: x.y = 5
model ClassInExtends
  model P
    Real y = 2;
  end P;
  model Q
    Real y = 5;
  end Q;
  model H
    replaceable model T = P;
    T x;
  end H;
  extends H(redeclare model T = Q);
end ClassInExtends;
