// code: R082
// line: 11
// hint: when something happens
impure function next
  output Real y;
algorithm
  y := 1;
end next;
model M
  Real x, z;
  Real y = next();
equation
  x = 1;
  when time > 0.5 then
    z = next();
  end when;
end M;
