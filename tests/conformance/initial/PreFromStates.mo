// section: 8.6
// value: first at 0 = 1, second at 0 = 0, first = 1, second = 0, counted = 0
model PreFromStates "What a Boolean with hysteresis was before the start follows from a state"
  Real x(start=0.5, fixed=true);
  Boolean on, off;
  Real first = if on then 1 else 0;
  Real second = if off then 1 else 0;
  discrete Integer counted(start=0, fixed=true);
initial equation
  pre(on) = x > 0.4;
  pre(off) = x > 0.6;
equation
  der(x) = 0;
  on = if pre(on) then x > 0.2 else x > 0.8;
  off = if pre(off) then x > 0.2 else x > 0.8;
  when change(on) or change(off) then
    counted = pre(counted) + 1;
  end when;
end PreFromStates;
