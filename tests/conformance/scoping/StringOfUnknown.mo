// section: 5.3
// refuse: R002 4
model StringOfUnknown
  parameter String s = nothere;
  Real x = time;
end StringOfUnknown;
