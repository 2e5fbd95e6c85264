// section: 8.5
// value: closed = true, x = 0.3
model ValveCloses "what the equation of a state depends on latches"
  Real x(start=0, fixed=true);
  Boolean closed(start=false, fixed=true) = x >= 0.3 or pre(closed);
equation
  der(x) = if closed then 0 else 1;
end ValveCloses;
