// section: 19
// refuse: U001 5
model UnitsDiffer
  Real x(unit="m") = 1;
  Real y(unit="s") = x;
end UnitsDiffer;
