// section: 11.2.3
// refuse: R059 7
model WhileOfUnknownLength
  Real x;
algorithm
  x := 0;
  while x < 10*time loop
    x := x + 1;
  end while;
end WhileOfUnknownLength;
