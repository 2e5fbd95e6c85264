// section: 7.3
// refuse: R034 10
model RedeclaredInAnotherSize "an array is redeclared in its size"
  model A
    Real y = 1;
  end A;
  model C
    replaceable A a[2];
  end C;
  C c(redeclare A a[3]);
end RedeclaredInAnotherSize;
