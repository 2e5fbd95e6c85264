// code: R091
// line: 7
// hint: variables it carries
expandable connector Bus
end Bus;
model M
  Bus bus;
end M;
