// section: 10.5
// value: y[1] = 2, y[2] = 3, y[3] = 0, z = 5
model BranchBeyondTheArrayInALoop
  function f
    input Real x[:];
    input Integer n;
    output Real y = 0;
  algorithm
    for i in 1:size(x, 1) loop
      y := y + (if i < n then x[i + 1] else 0);
    end for;
  end f;
  Integer n = if time > 0.5 then 3 else 2;
  Real x[3] = {1, 2, 3}*time;
  Real y[3];
  Real z = f(x, n);
equation
  for i in 1:3 loop
    y[i] = if i < n then x[i + 1] else 0;
  end for;
end BranchBeyondTheArrayInALoop;
