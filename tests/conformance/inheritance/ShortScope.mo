// section: 7.2.1
// value: b.y = 1
model ShortScope
  constant Real x = 1;
  model A
    constant Real x = 2;
    Real y = 3;
  end A;
  model B = A(y=x);
  B b;
end ShortScope;
