// section: 7.1
// refuse: R010 8
model A
  Real x = 2;
end A;
model InheritedTwiceModified
  extends A;
  extends A(x = 3);
end InheritedTwiceModified;
