// section: 4.8
// refuse: R078 7
connector C
  Real e;
  flow Real f;
end C;
model A
  C c;
equation
  c.e = 1;
  c.f = 2;
end A;
model ComponentGivesFlowAndPotential
  A a;
  A b;
end ComponentGivesFlowAndPotential;
