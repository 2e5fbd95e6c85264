// section: 11.1.2
// value: y = 3, x = 7
model ReadBeforeAssignment
  Real x(start=2), y;
algorithm
  y := x + 1;
  x := 7;
end ReadBeforeAssignment;
