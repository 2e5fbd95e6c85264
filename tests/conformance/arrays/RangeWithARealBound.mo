// section: 10.4.3
// refuse: R024 4
model RangeWithARealBound
  Integer x[2] = 1:2.5;
end RangeWithARealBound;
