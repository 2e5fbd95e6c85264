// section: 11.2.2
// value: y = 11
model ForOverArray
  Real y;
algorithm
  y := 0;
  for v in {1, 3, 7} loop
    y := y + v*time;
  end for;
end ForOverArray;
