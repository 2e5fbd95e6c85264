// section: 8.3.5
// value: n = 2, n at 0.5 = 1
model WhenOfAVector "a vector of conditions: any that becomes true"
  Integer n(start=0, fixed=true);
equation
  when {time > 0.32, time > 0.72} then
    n = pre(n) + 1;
  end when;
end WhenOfAVector;
