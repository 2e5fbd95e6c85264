// section: 8.3.4
// refuse: R024 9
model TypeInABranchNotTaken "the types of a branch fit, taken or not"
  parameter Boolean detailed = false annotation(Evaluate=true);
  Boolean high = time > 0.5;
  Real x;
equation
  if detailed then
    x = high;
  else
    x = time;
  end if;
end TypeInABranchNotTaken;
