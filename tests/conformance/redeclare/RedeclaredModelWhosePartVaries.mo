// section: 6.4
// refuse: R034 15
model RedeclaredModelWhosePartVaries "a redeclaration with a lower variability demanded"
  model A
    parameter Real p = 1;
    Real x = p;
  end A;
  model B
    Real p = time;
    Real x = p;
  end B;
  model C
    replaceable A a;
  end C;
  C c(redeclare B a);
end RedeclaredModelWhosePartVaries;
