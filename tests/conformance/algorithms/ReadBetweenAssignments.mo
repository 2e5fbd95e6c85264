// section: 11.1
// value: x = 1, n = 2, y at 0.4 = 0, y = 3
model ReadBetweenAssignments
  Real x;
  Real y;
  Integer n;
  Integer m(start = 0, fixed = true);
algorithm
  n := 1;
  x := n;
  n := 2;
  y := m;
  when time > 0.5 then
    m := 3;
  end when;
  y := m;
end ReadBetweenAssignments;
