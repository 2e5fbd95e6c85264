// section: 5.6.4
// refuse: R010 5
model DeclaredTwice
  Real x = 1;
  Real x = 2;
end DeclaredTwice;
