// section: 10.3.4
// value: a = false, b = true
model MinOfBooleans
  Boolean a = min({true, time > 2, true});
  Boolean b = max({false, time > -1});
end MinOfBooleans;
