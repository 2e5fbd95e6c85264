// section: 12.4.6
// value: n = 2
model EdgeOfArray
  Boolean b[2] = {time > 0.3, time > 0.6};
  Integer n(start = 0, fixed = true);
equation
  when edge(b) then
    n = pre(n) + 1;
  end when;
end EdgeOfArray;
