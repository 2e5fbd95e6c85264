// section: 3.7.2
// value: a = -1, b = 0, c = -2
model IntegerOfNegative "towards minus infinity"
  Integer a = integer(-0.5*time - 1e-3), b = integer(0.5*time), c = integer(-1.5*time);
end IntegerOfNegative;
