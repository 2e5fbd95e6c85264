// section: 8.3.6
// refuse: R056 10
model ReinitInABranchNotTaken "a reinit outside of when is none, in a branch that is taken or not"
  parameter Boolean resets = false;
  Real x(start=1, fixed=true);
equation
  der(x) = -x;
  if resets then
    if time > 1 then
      reinit(x, 1);
    end if;
    connect(x, x);
  end if;
end ReinitInABranchNotTaken;
