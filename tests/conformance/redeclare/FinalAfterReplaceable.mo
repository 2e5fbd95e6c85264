// section: A.2.3
// refuse: P021 7
model A
  Real x = 2;
end A;
model C
  replaceable final A a;
end C;
model FinalAfterReplaceable
  C c;
end FinalAfterReplaceable;
