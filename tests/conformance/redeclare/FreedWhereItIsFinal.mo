// section: 6.4
// refuse: R034 15
model FreedWhereItIsFinal "a final element of the constraining class that the other lets free"
  model A
    final parameter Real p = 1;
    Real x = p;
  end A;
  model B
    parameter Real p = 2;
    Real x = p;
  end B;
  model C
    replaceable A a;
  end C;
  C c(redeclare B a);
end FreedWhereItIsFinal;
