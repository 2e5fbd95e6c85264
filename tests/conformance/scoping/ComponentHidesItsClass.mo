// section: 5.3.1
// refuse: R074 7
model Y
  Real x = 1;
end Y;
model ComponentHidesItsClass
  Y a;
  Real Y = 3;
end ComponentHidesItsClass;
