// section: 5.3
// refuse: R002 8
model NameInABranchNotTaken "a branch that a known condition leaves out names what there is"
  parameter Boolean detailed = false annotation(Evaluate = true);
  Real x;
equation
  if detailed then
    x = nowhere;
  else
    x = time;
  end if;
end NameInABranchNotTaken;
