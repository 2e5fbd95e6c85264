// section: 7.2.3
// refuse: R032 9
model ValueForAType "the type Set takes no value; set does"
  model A
    type Set = Real(min = 0);
    parameter Set set = 1;
    Real x = set*time;
  end A;
  A a(Set = 50);
end ValueForAType;
