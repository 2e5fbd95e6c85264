// code: P018
// line: 5
// hint: a backslash
model M
  parameter String file = "C:\Users\data.csv";
  Real x = time;
end M;
