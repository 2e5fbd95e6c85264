// section: 8.3.4
// value: x = 1
model BranchOutsideItsArray
  parameter Integer k = 3;
  parameter Real t[2] = {1, 2};
  Real x;
equation
  if k <= 2 then
    x = t[k];
  else
    x = 1;
  end if;
end BranchOutsideItsArray;
