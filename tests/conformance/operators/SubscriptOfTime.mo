// section: 10.5
// refuse: R044 4
model SubscriptOfTime
  Real x = time[2];
end SubscriptOfTime;
