// section: 11.2.7
// value: n at 0.25 = 1, n = 2
model WhenInAlgorithm
  Integer n(start=0, fixed=true);
algorithm
  when {time > 0.2, time > 0.4} then
    n := pre(n) + 1;
  end when;
end WhenInAlgorithm;
