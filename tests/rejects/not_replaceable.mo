// code: R033
// line: 11
// hint: replaceable
model A
  Real x = time;
end A;
model Host
  A a;
end Host;
model M
  Host host(redeclare A a);
end M;
