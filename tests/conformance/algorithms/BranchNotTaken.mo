// section: 11.2.6
// value: x = 3
model BranchNotTaken
  Real x;
  parameter Integer i = 4;
algorithm
  if i == 4 then
    x := 3.0;
  elseif i == 3 then
    assert(false, "not to be evaluated");
  end if;
end BranchNotTaken;
