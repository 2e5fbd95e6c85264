// section: 12.4.5
// value: n = 2, s = 3
model ArrayGrowsInside
  function positive
    input Real x[:];
    output Real y[:];
  algorithm
    for i in 1:size(x, 1) loop
      if x[i] > 0 then
        y := cat(1, y, {x[i]});
      end if;
    end for;
  end positive;
  function count
    input Real x[:];
    output Integer n;
    output Real s;
  algorithm
    n := size(positive(x), 1);
    s := sum(positive(x));
  end count;
  parameter Real a[3] = {1, -1, 2};
  Integer n;
  Real s;
equation
  (n, s) = count(a);
end ArrayGrowsInside;
