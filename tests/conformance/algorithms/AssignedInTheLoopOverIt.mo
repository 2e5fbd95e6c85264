// section: 11.2.2.1
// refuse: R058 8
model AssignedInTheLoopOverIt "an array that the loop's implicit range is taken from is not assigned as a whole"
  Real x[3];
algorithm
  x := {1, 2, 3};
  for i loop
    x := fill(2.0, 3);
    x[i] := i;
  end for;
end AssignedInTheLoopOverIt;
