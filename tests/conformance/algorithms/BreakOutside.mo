// section: 11.2.4
// refuse: R059 7
model BreakOutside
  Real x;
algorithm
  x := 1;
  break;
end BreakOutside;
