// code: R038
// line: 8
// hint: each
model A
  parameter Real x = 2;
end A;
model M
  A a(each x = 3);
end M;
