// section: 4.8
// refuse: R078 3
model A
  Real x;
  Real y; 
equation
  x = 1;
end A;
model ComponentLacksAnEquation
  A a;
equation
  a.y = 2;
end ComponentLacksAnEquation;
