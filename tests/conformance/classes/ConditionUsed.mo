// section: 4.4.5
// refuse: R016 9
model ConditionUsed
  model A
    Real x = 3;
  end A;
  parameter Boolean wanted = true;
  A a if wanted;
  Real y = a.x;
end ConditionUsed;
