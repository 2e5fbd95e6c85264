// section: 12.8
// value: y = 40
model TextOfManyBranches "Inlined, its text would have a million branches"
  function f
    input Real k;
    input Real x;
    output Real y;
  algorithm
    y := 0;
    for i in 1:20 loop
      if y < 1e6 then
        y := y + k*x;
      end if;
    end for;
  end f;
  parameter Real p = 2;
  Real y = f(p, time);
end TextOfManyBranches;
