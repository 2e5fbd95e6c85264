// section: 4.9.4
// refuse: R020 4
model StringBoundToNumber
  parameter String s = 3 "not used by anything";
  Real x = time;
end StringBoundToNumber;
