// section: 5.6.1
// refuse: R003 9
model ElementMissing
  model A
    constant Real B = 1;
    Real x = 2;
  end A;
  A a;
  Real y = a.z;
end ElementMissing;
