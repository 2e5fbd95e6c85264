// section: 4.4.3
// value: x = 2
model CircleThatEvaluateBreaks "a circle that Evaluate resolves"
  parameter Boolean b = true annotation(Evaluate=true);
  parameter Real p = if b then 2 else q;
  parameter Real q = if b then p else 3;
  Real x = q;
end CircleThatEvaluateBreaks;
