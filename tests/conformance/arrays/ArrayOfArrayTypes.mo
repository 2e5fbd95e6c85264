// section: 7.2.5
// value: x[2,3] = 3, y[1,2] = 2
model ArrayOfArrayTypes "What a type says of its elements holds in each element of an array of the type"
  type T = Real[3](start = {1, 2, 3}, each fixed = true);
  type U = T[1];
  T x[2];
  U y;
equation
  der(x) = zeros(2, 3);
  der(y) = zeros(1, 3);
end ArrayOfArrayTypes;
