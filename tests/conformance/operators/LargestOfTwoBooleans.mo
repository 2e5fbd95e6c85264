// section: 3.7
// value: a = true, b = 3, c = -2
model LargestOfTwoBooleans
  Boolean a = max(false, true);
  Real b = max({1, 3, 2});
  Integer c = min(3, -2);
end LargestOfTwoBooleans;
