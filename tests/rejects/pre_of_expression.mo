// code: R052
// line: 8
// hint: variable of its own
model M
  discrete Real x(start = 0);
equation
  when time > 1 then
    x = pre(2*x);
  end when;
end M;
