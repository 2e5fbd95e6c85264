// code: R053
// line: 7
// hint: parameters
model M
  discrete Real x(start = 0);
equation
  when sample(0, 1 + time) then
    x = pre(x) + 1;
  end when;
end M;
