// section: 4.9.8
// refuse: S014 4
model StateSelectNever
  Real x(start=1, fixed=true, stateSelect=StateSelect.never);
equation
  der(x) = -x;
end StateSelectNever;
