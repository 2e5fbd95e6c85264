// code: R059
// line: 8
// hint: function
model M
  Integer n;
algorithm
  n := 0;
  while n < 3 loop
    n := n + 1;
  end while;
end M;
