// section: 13.4
// refuse: R001 4
within Nowhere.Else;
model WithinNothing
  Real x = 1;
end WithinNothing;
