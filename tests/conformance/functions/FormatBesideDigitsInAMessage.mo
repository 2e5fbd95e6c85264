// section: 3.7.1
// refuse: R050 6
model FormatBesideDigitsInAMessage "a format stands in place of all other options, in a message as well"
  Real x = time;
equation
  assert(x < 2, String(x, format="5.2f", significantDigits=3));
end FormatBesideDigitsInAMessage;
