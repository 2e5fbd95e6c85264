// section: 4.5.1
// refuse: R036 4
model ScalarAttributeOfAnArrayType
  type T = Real[2](start = 1);
  T y;
equation
  y = {time, time};
end ScalarAttributeOfAnArrayType;
