// section: 10.4.3
// value: n = 0, s = 0
model RangeEmpty
  Integer n = size(3:1, 1);
  Real s = sum(3:1);
end RangeEmpty;
