// code: R054
// line: 8
// hint: only Reals
model M
  Integer n(start = 0);
  Real x;
equation
  x = der(n);
  when time > 1 then
    n = 1;
  end when;
end M;
