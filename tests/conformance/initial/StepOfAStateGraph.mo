// section: 8.6
// value: active at 0.2 = 1, active = 0
model StepOfAStateGraph "what pre(next) is at the start follows from active = true"
  Boolean active, next;
initial equation
  active = true;
  pre(next) = pre(active);
equation
  active = pre(next);
  next = if time > 0.5 then false else true;
end StepOfAStateGraph;
