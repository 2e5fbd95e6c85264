// section: 11.1.2
// value: d1 = 4, d2 = 9
model ReadBeforeAndPre "what is read before it is assigned, and pre of what is assigned before"
  Integer d1(start=1, fixed=true), d2(start=0, fixed=true);
algorithm
  d1 := mod(min(d2, 4), 13);
  d2 := mod(min(pre(d1) + 5, 22), 13);
end ReadBeforeAndPre;
