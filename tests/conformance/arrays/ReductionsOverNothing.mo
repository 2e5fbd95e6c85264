// section: 10.3.4.1
// value: a = 0, b = 1, c = -1.7976931348623157e308
model ReductionsOverNothing "reductions over nothing"
  Real a = sum(i for i in 1:0);
  Real b = product(i for i in 1:0);
  Real c = max(i*1.0 for i in 1:0);
end ReductionsOverNothing;
