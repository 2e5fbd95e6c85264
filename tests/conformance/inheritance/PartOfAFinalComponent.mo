// section: 7.2.6
// refuse: R031 12
model PartOfAFinalComponent
  model A
    parameter Real p = 1;
    Real x = p;
  end A;
  model B
    final A a(p=3);
  end B;
  B b(
    a(p=4));
end PartOfAFinalComponent;
