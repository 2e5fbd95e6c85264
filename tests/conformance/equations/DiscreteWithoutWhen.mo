// section: 3.8.5
// refuse: R063 4
model DiscreteWithoutWhen
  discrete Real x = time;
end DiscreteWithoutWhen;
