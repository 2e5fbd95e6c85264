// section: 7.3
// refuse: R034 13
model ComponentAsAClass "a class stands for a class, a component for a component"
  model One
    Real x = 1;
  end One;
  model Two
    Real x = 2;
  end Two;
  model A
    replaceable One r;
  end A;
  A a(redeclare model r = Two);
end ComponentAsAClass;
