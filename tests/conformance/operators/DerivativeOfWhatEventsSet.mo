// section: 3.7.4
// refuse: R054 9
model DerivativeOfWhatEventsSet
  Real w, w1;
equation
  when sample(0.1, 0.1) then
    w = time;
  end when;
  w1 = der(w);
end DerivativeOfWhatEventsSet;
