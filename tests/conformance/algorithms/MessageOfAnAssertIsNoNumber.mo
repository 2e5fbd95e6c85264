// section: 8.3.7
// refuse: R020 6
model MessageOfAnAssertIsNoNumber "also where the condition holds at all times"
  Real x = time;
equation
  assert(true, 3);
end MessageOfAnAssertIsNoNumber;
