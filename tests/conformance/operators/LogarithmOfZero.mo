// section: 3.7.3
// refuse: R064 4
model LogarithmOfZero
  Real y = log(0);
end LogarithmOfZero;
