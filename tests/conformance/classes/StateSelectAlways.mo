// section: 4.9.8
// refuse: S014 4
model StateSelectAlways
  Real x(stateSelect=StateSelect.always) = time;
end StateSelectAlways;
