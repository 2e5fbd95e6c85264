// section: 5.3.1
// refuse: R002 6
model OuterVariable
  Real g = 4;
  model A
    Real y = g;
  end A;
  A a;
end OuterVariable;
