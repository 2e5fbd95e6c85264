// section: 4.4.5
// refuse: R032 9
model RedeclaredWithACondition "a redeclaration with a condition"
  model A
    replaceable Real x = 1;
  end A;
  model B
    extends A;
    redeclare Real x = 2 if true;
  end B;
  B b;
end RedeclaredWithACondition;
