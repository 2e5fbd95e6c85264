// code: F032
// line: 9
// hint: assign it first
model M
  Real x, y;
algorithm
  y := x + 1;
  if time > 1 then
    x := y;
  end if;
end M;
