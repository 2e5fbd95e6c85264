// section: 8.6
// value: n = 8
model PreOfDiscrete
  Integer n;
initial equation
  pre(n) = 7;
equation
  when time > 0.5 then
    n = pre(n) + 1;
  end when;
end PreOfDiscrete;
