// section: 7.3
// value: a.s = 6
model SizesOnly
  model A
    Real x[:] = ones(size(x, 1));
    Real s = sum(x);
  end A;
  A a(redeclare Real x[6]);
end SizesOnly;
