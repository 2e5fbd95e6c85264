// code: R065
// line: 7
// hint: pre(m)
model M
  Integer n(start = 0), m(start = 0);
equation
  when time > 2 then
    n = 1;
    m = 1;
  elsewhen time > 1 then
    n = 2;
  end when;
end M;
