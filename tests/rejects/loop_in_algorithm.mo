// code: R059
// line: 8
// hint: function
model M
  Real x;
algorithm
  x := 0;
  while x < time loop
    x := x + 1;
  end while;
end M;
