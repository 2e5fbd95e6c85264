// section: 4.4.5
// value: y = 1
model ConditionFalse
  model A
    Real x = 3;
  end A;
  parameter Boolean wanted = false;
  A a if wanted;
  Real y = 1;
end ConditionFalse;
