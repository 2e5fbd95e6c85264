// code: R074
// line: 5
// hint: rename it
model M
  Real Integer = 1;
end M;
