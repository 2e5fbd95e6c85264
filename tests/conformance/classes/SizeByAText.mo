// section: 4.5
// refuse: R024 4
model SizeByAText "a whole number has no text as its value"
  parameter Integer m = "Number of phases";
  Real x[m];
equation
  x = zeros(m);
end SizeByAText;
