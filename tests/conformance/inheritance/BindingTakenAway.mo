// section: 7.2.7
// value: x = 3
model A
  Real x = 1;
end A;
model BindingTakenAway
  extends A(final x = break);
algorithm
  x := 0;
  while x < 3 loop
    x := x + 1;
  end while;
end BindingTakenAway;
