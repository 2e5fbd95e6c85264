// section: 4.4.2
// refuse: P021 4
model TwoVariabilities
  parameter constant Real x = 1;
end TwoVariabilities;
