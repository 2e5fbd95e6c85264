// section: 8.3.5
// refuse: R063 6
model DiscreteThatFollows
  discrete Real d;
equation
  d = 2*time + 1;
end DiscreteThatFollows;
