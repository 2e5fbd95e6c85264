// section: 8.5
// value: n = 2
model WhenOfTwoBooleans
  Integer n(start=0, fixed=true);
  Boolean a = time > 0.3;
  Boolean b = time > 0.6;
equation
  when {a, b} then
    n = pre(n) + 1;
  end when;
end WhenOfTwoBooleans;
