// section: 10.1
// refuse: R043 4
model SizeOfNoStartValues
  Real x[:](each start=1);
equation
  x = {time, 2};
end SizeOfNoStartValues;
