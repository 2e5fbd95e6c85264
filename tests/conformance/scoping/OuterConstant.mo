// section: 5.3.1
// value: a.y = 4
model OuterConstant
  constant Real g = 4;
  model A
    Real y = g;
  end A;
  A a;
end OuterConstant;
