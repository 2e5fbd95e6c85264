// code: R019
// line: 8
// hint: did you mean forward
type Mode = enumeration(locked, forward, backward);
model M
  Integer x;
equation
  x = Integer(Mode.forwrd);
end M;
