// section: 8.3.5.1
// refuse: R058 7
model WhenOfExpression
  discrete Real y(start=0, fixed=true);
equation
  when time > 0.5 then
    2*y = 1;
  end when;
end WhenOfExpression;
