// section: 16.4
// refuse: R091 4
model ClockDeclared
  Clock c = Clock(0.1);
  Real x = 1;
end ClockDeclared;
