// code: R025
// line: 10
// hint: literals of Mode
type Mode = enumeration(locked, forward, backward);
model M
  Mode mode(start = Mode.locked);
  Real x = if mode == Mode.locked then 0 else 1;
equation
  when time > 1 then
    mode = 2;
  end when;
end M;
