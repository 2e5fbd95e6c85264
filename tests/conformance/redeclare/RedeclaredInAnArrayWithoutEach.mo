// section: 7.2.5
// refuse: R038 10
model RedeclaredInAnArrayWithoutEach "a redeclaration is not split among the elements of an array"
  model A
    replaceable Real x = 1;
  end A;
  model B
    A a[2];
  end B;
  B b(a(redeclare Real x = {1, 2}));
end RedeclaredInAnArrayWithoutEach;
