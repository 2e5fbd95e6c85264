// section: 3.7.2
// refuse: R064 4
model RootOfANegativeNumber
  Real y = sqrt(-1);
end RootOfANegativeNumber;
