// section: 11.2.2
// value: x = 16.5
model LoopOverVector
  Real x;
algorithm
  x := 0;
  for v in {1.5, 5, 10} loop
    x := x + v;
  end for;
end LoopOverVector;
