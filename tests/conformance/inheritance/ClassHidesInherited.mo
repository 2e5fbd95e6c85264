// section: 7.1
// refuse: R010 9
model A
  model T
    Real x = 2;
  end T;
end A;
model ClassHidesInherited
  model T
    Real x = 3;
  end T;
  extends A;
  T t;
end ClassHidesInherited;
