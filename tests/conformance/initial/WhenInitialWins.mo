// section: 8.6
// value: n = 4
model WhenInitialWins
  Integer n;
initial algorithm
  n := 2;
equation
  when {initial(), time > 0.5} then
    n = 4;
  end when;
end WhenInitialWins;
