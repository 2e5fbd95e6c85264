// section: 3.7.5
// refuse: R052 5
model ChangeOfWhatVariesContinuously "change of a continuous variable outside of when"
  Real x = time;
  Boolean y = change(x);
end ChangeOfWhatVariesContinuously;
