// section: 8.6
// value: a = -2, b = -2, c = 2, d = -2
model StartDecidesABranch "of two solutions, the one whose relations hold at the start values"
  Real a(start=-1);
  Real b(start=-1);
  Real c(start=1);
  Real d(start=-5);
equation
  abs(a) = 1 + time;
  max(b, -b) = 1 + time;
  abs(c) = 1 + time;
  abs(d - 1) = 2 + time;
end StartDecidesABranch;
