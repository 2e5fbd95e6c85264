// section: 7.2
// value: a.x = 2
model SplitModification
  model A
    Real x(start=1);
  equation
    der(x) = 0;
  end A;
  A a(x(start=2), x.fixed=true);
end SplitModification;
