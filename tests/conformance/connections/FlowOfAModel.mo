// section: 4.4.2.2
// value: x = 1, y = 1
model FlowOfAModel
  flow Real x;
  Real y = x;
equation
  x = time;
end FlowOfAModel;
