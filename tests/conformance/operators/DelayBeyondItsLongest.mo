// section: 3.7.4
// refuse: R053 4
model DelayBeyondItsLongest "a delay longer than its largest"
  Real x = delay(time, 0.5, 0.2);
end DelayBeyondItsLongest;
