// section: 4.5.1
// value: y[2] = 2, z[2,2] = 2
model AttributesOfAnArrayType
  type Q = Real(start = 1);
  type T = Q[2](start = {1, 2}, each fixed = true);
  type S = T;
  S y;
  T z[2];
equation
  der(y) = {0, 0};
  der(z) = zeros(2, 2);
end AttributesOfAnArrayType;
