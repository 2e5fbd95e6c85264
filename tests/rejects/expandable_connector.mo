// code: R091
// line: 4
// hint: variables it carries
expandable connector Bus
end Bus;
model M
  Bus bus;
end M;
