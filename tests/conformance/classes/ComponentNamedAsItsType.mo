// section: 4.2
// refuse: R074 7
record R
  Real x;
end R;
model ComponentNamedAsItsType
  R R;
equation
  R.x = 0;
end ComponentNamedAsItsType;
