// section: 11.2.2
// refuse: R047 7
model LoopOverMatrix
  Real x;
algorithm
  x := 0;
  for v in {{1, 2}, {3, 4}} loop
    x := x + v[1];
  end for;
end LoopOverMatrix;
