// section: 10.5
// value: w[3] = 2.28, b2[2] = 10
model IndexedByTypes
  type SS = enumeration(small, medium, large);
  Real[SS] w;
  Real[Boolean] b2;
algorithm
  w := {1, 1, 1};
  w[SS.large] := 2.28;
  b2 := {1, 1};
  b2[true] := 10.0;
end IndexedByTypes;
