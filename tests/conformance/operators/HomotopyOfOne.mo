// section: 3.7.4.4
// refuse: R050 4
model HomotopyOfOne
  Real y = homotopy(2*time);
end HomotopyOfOne;
