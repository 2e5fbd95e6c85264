// section: 11.2.2
// value: x = 4
model LoopOverNothing
  Real x;
algorithm
  x := 4;
  for i in 2:1 loop
    x := 7;
  end for;
end LoopOverNothing;
