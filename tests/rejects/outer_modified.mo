// code: R076
// line: 5
// hint: modify the inner one
model Part
  outer Real t = 2;
  Real x = t;
end Part;
model M
  inner Real t = 1;
  Part p;
end M;
