// section: 10.1
// value: x[3] = 3, n = 3
model SizeOfStartValues
  Real x[:](start={1, 2, 3}, each fixed=true);
  parameter Integer n = size(x, 1);
equation
  for i in 1:n loop
    der(x[i]) = 0;
  end for;
end SizeOfStartValues;
