// section: 10.3.3
// value: x = 7
model ScalarOfOne
  Real x = scalar({{7}});
end ScalarOfOne;
