// section: 12.2
// value: x[1] = 1, x[3] = 9
model SizeFromAnInput
  function squares
    input Integer n;
    output Real y[n];
  algorithm
    for i loop
      y[i] := i^2;
    end for;
  end squares;
  parameter Integer m = 3;
  Real x[m] = squares(m);
end SizeFromAnInput;
