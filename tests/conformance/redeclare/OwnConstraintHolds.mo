// section: 7.3.2
// refuse: R034 18
model Resistor
  parameter Real R = 1;
end Resistor;
model Thermo
  extends Resistor;
  parameter Real T0 = 20;
end Thermo;
model Circuit
  replaceable model NR = Resistor(R = 100);
  NR r;
end Circuit;
model Circuit4
  extends Circuit(redeclare replaceable model NR = Thermo constrainedby Thermo);
end Circuit4;
model OwnConstraintHolds
  extends Circuit4(redeclare replaceable model NR = Resistor);
end OwnConstraintHolds;
