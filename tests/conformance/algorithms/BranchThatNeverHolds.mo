// section: 11.1.2
// value: y = 3, z = 4
model BranchThatNeverHolds "z is given by the algorithm also where its only assignment is not reached"
  Real y;
  Real z(start = 4);
algorithm
  y := 3;
  if y < 2 then
    z := 1;
  end if;
end BranchThatNeverHolds;
