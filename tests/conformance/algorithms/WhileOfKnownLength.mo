// section: 11.2.3
// value: x = 16
model WhileOfKnownLength
  Real x;
  Real n;
algorithm
  x := 1;
  n := 0;
  while n < 4 loop
    x := 2*x;
    n := n + 1;
  end while;
end WhileOfKnownLength;
