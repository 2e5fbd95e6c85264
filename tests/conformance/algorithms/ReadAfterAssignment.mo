// section: 11.1.2
// value: y = 8
model ReadAfterAssignment
  Real x, y;
algorithm
  x := 7;
  y := x + 1;
end ReadAfterAssignment;
