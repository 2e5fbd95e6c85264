// section: 11.2.6
// value: x = 5
model BranchOutsideItsArray
  parameter Integer k = 3;
  parameter Real t[2] = {1, 2};
  Real x;
algorithm
  if k <= 2 then
    x := t[k];
  else
    x := 5;
  end if;
end BranchOutsideItsArray;
