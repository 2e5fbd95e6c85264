// section: 7.1.2
// refuse: R010 8
model InheritedAndDifferent
  model A
    Real x = 1;
  end A;
  extends A;
  Real x = 2;
end InheritedAndDifferent;
