// section: 7.2.4
// refuse: R030 9
model A
  Real r(start = 1, fixed = true);
equation
  der(r) = 0;
end A;
model AttributeTwice
  A m1(r.start = 2, r(start = 3));
end AttributeTwice;
