// section: 4.9.8
// value: y = 0
model StateSelectParameter
  model I
    parameter StateSelect choice = StateSelect.default;
    Real x(stateSelect=choice, start=0, fixed=true);
  equation
    der(x) = 0;
  end I;
  I i(choice=StateSelect.always);
  Real y = i.x;
end StateSelectParameter;
