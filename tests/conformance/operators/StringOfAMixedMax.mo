// section: 3.7.2
// value: x = 1
model StringOfAMixedMax "max of an Integer and a Real is a Real"
  Real x = if String(max(7, 2.0), significantDigits=3) == "7.00" or String(max(7, 2.0), significantDigits=3) == "7" then 1 else 0;
end StringOfAMixedMax;
