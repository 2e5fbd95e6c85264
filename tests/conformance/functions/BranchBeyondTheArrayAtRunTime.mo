// section: 10.5
// value: y = 4
model BranchBeyondTheArrayAtRunTime
  function f
    input Real x[:];
    input Integer n;
    output Real y;
  algorithm
    y := 0;
    for i in 1:size(x, 1) loop
      y := y + (if i < n then x[i + 1] else if i + 1 > size(x, 1) then -1 else 0);
    end for;
  end f;
  Integer n = if time > 0.5 then 3 else 3;
  Real y = f({1, 2, 3, 4}, m);
  Integer m(start=3, fixed=true);
equation
  when time > 0.5 then
    m = 3;
  end when;
end BranchBeyondTheArrayAtRunTime;
