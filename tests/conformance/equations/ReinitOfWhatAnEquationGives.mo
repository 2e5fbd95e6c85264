// section: 8.3.6
// refuse: C002 7
model ReinitOfWhatAnEquationGives
  Real x = 2 - time;
equation
  when time > 0.5 then
    reinit(x, 0);
  end when;
end ReinitOfWhatAnEquationGives;
