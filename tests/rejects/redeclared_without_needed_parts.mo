// code: R034
// line: 14
// hint: choose a class
model A
  Real x = time;
end A;
model B
  Real y = time;
end B;
model Host
  replaceable A a;
end Host;
model M
  Host host(redeclare B a);
end M;
