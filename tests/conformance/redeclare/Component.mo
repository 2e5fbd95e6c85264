// section: 7.3
// value: m.r.v = 6
model Component
  model Plain
    Real v = 2;
  end Plain;
  model Other
    Real v = 2*k;
    parameter Real k = 1;
  end Other;
  model Holder
    replaceable Plain r;
  end Holder;
  Holder m(redeclare Other r(k=3));
end Component;
