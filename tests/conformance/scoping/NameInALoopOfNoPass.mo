// section: 5.3
// refuse: R003 12
model NameInALoopOfNoPass "a loop that is passed no time names what there is"
  model Cell
    Real x;
  equation
    x = time;
  end Cell;
  parameter Integer n = 0;
  Cell cell[2];
equation
  for i in 1:n loop assert(cell[i].y < 1, "too large"); end for;
end NameInALoopOfNoPass;
