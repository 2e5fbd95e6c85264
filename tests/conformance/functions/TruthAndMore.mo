// section: 12.4.3
// value: q at 0.1 = false, y at 0.1 = 10, q = true, y = 12
model TruthAndMore "a loop, whose first result of two is a Boolean"
  function f
    input Integer n;
    input Boolean b;
    output Boolean q;
    output Integer y;
  algorithm
    y := n;
    q := b;
    while y < 10 loop
      y := y + n;
    end while;
  end f;
  Boolean q;
  Integer y;
  Integer e = if time > 0.5 then 3 else 1;
equation
  (q, y) = f(e, time > 0.2);
end TruthAndMore;
