// section: 4.4.5
// refuse: R032 10
model ConditionInAModification "a redeclaration has no condition"
  model R1
    Real x = 1;
  end R1;
  model A
    replaceable R1 r if true;
  end A;
  A a(redeclare R1 r if false);
end ConditionInAModification;
