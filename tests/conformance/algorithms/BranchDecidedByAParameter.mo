// section: 11.2.6
// value: x = 2, y = 2, z = 3
model BranchDecidedByAParameter "inside of when; others stand behind it"
  parameter Integer n = 2;
  constant Boolean never = false;
  Real v[n] = fill(time, n);
  discrete Real x(start=0, fixed=true), y(start=0, fixed=true), z(start=0, fixed=true);
algorithm
  when time > 0.5 then
    if y > 1 then
      x := 1;
    elseif n < 3 then
      x := 2;
    elseif y > 0 then
      x := 3;
    else
      x := 4;
    end if;
    if n == 2 then
      y := 2;
    elseif x > 5 then
      y := 7;
    end if;
    if never or n > 2 then
      z := 1;
    else
      z := 3;
    end if;
  end when;
end BranchDecidedByAParameter;
