// section: 10.4.3
// value: x[1] = 5, x[3] = 1
model RangeDownwards
  Real x[3] = 5:-2:1;
end RangeDownwards;
