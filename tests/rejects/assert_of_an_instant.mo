// code: R056
// line: 7
// hint: when
model M
  Boolean b = time > 0.5;
equation
  assert(not edge(b), "it is never seen: asserts are checked where an event is over");
end M;
