// code: P012
// line: 5
// hint: rename
model M
  Real flow;
equation
  flow = time;
end M;
