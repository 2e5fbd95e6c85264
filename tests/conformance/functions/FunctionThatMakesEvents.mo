// section: 12.8
// value: b1 = true, b1 at 0.2 = false, b4 = true, z = 2, z at 0.2 = 1
function greaterEqual
  input Real x1;
  input Real x2;
  output Boolean b;
algorithm
  b := x1 >= x2;
  annotation(GenerateEvents = true, LateInline = true);
end greaterEqual;
function greaterEqualWO
  input Real x1;
  input Real x2;
  output Boolean b;
algorithm
  b := x1 >= x2;
  annotation(LateInline = true);
end greaterEqualWO;
model FunctionThatMakesEvents
  Boolean b1 = greaterEqual(time, 0.5);
  Boolean b4 = greaterEqualWO(if b1 then 2 else 0, 1);
  Real z = if greaterEqualWO(time, 0.5) then 2 else 1;
end FunctionThatMakesEvents;
