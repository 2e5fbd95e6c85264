// section: 11.2.2
// value: s = 10, x[1] = 3, x[2] = 7, z = 14
model RowsOfAMatrix "a loop runs over the rows of a matrix: a vector of vectors (8.3.3)"
  function f
    input Real a[:, 2];
    output Real y;
  algorithm
    y := 0;
    for v in a loop
      y := y + v[1]*v[2];
    end for;
  end f;
  parameter Real A[2, 2] = {{1, 2}, {3, 4}};
  Real s, x[2], z = f(time*A);
equation
  x = {sum(v) for v in A};
algorithm
  s := 0;
  for v in {{1, 2}, {3, 4}} loop
    s := s + v[1]*time + v[2];
  end for;
end RowsOfAMatrix;
