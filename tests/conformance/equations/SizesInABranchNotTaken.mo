// section: 8.3.4
// value: x[1] at 1 = 1, x[2] at 1 = 2, z = 3
model SizesInABranchNotTaken "what fits for other sizes only is no fault of a branch that is not taken"
  parameter Integer n = 2;
  parameter Real T[:, :] = fill(0, 0, 2);
  model Part
    parameter Integer m = 0;
    parameter Real first = T[1];
    parameter Real T[:];
    Real y = sum(T)/m;
  end Part;
  Part part(m=n, T={1.0, 2.0}) if n > 2;
  Real x[n];
  Real z = 3;
  discrete Real held(start=0, fixed=true);
equation
  if n == 1 then
    x[1] = time;
  elseif n == 3 then
    x = {T[1, 1], T[1, 2], pre(held)} + vector(T[n - 2:n, 1]);
  else
    x = {time, 2*time};
  end if;
  when sample(0.5, 0.5) then
    held = time;
  end when;
end SizesInABranchNotTaken;
