// section: 8.3.5
// refuse: S013 8
model WhenEquationOfItself "What stands on the right is the new value"
  Integer n(start = 0, fixed = true);
  Boolean b = time > 0.5;
equation
  when b then
    n = n + 1;
  end when;
end WhenEquationOfItself;
