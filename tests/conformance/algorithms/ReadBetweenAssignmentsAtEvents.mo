// section: 11.1
// refuse: R059 8
model ReadBetweenAssignmentsAtEvents
  Real x;
  Integer n(start = 0, fixed = true);
algorithm
  n := 1;
  x := n*time;
  n := 2;
  when time > 0.5 then
    n := 3;
  end when;
end ReadBetweenAssignmentsAtEvents;
