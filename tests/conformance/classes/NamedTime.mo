// section: 3.6.7
// refuse: R074 4
model NamedTime
  Real time = 1;
  Real x = 2*time;
end NamedTime;
