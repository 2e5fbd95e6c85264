// section: 8.6
// value: top = 2
model DiscreteFromAState
  Real x(start=2, fixed=true);
  discrete Real top;
initial equation
  top = x;
equation
  der(x) = -x;
  when x < 0.01 then
    top = x;
  end when;
end DiscreteFromAState;
