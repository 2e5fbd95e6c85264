// code: R093
// line: 5
// hint: one import a line
model M
  import A.{b, c};
  Real x = time;
end M;
