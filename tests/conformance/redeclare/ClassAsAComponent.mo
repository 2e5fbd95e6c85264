// section: 7.3
// refuse: R034 14
model ClassAsAComponent "a class stands for a class, a component for a component"
  model One
    Real x = 1;
  end One;
  model Two
    Real x = 2;
  end Two;
  model A
    replaceable model R = One;
    R r;
  end A;
  A a(redeclare Two R);
end ClassAsAComponent;
