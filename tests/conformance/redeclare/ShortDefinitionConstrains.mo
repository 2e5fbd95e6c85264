// section: 7.3.2
// value: a.r.R = 100, a.r.T0 = 300, b.r.R = 200, c.r.R = 100
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
model Circuit2
  extends Circuit(redeclare replaceable model NR = Thermo(T0 = 300));
end Circuit2;
model ShortDefinitionConstrains
  Circuit2 a;
  Circuit2 b(redeclare replaceable model NR = Resistor(R = 200));
  Circuit2 c(redeclare replaceable model NR = Resistor);
end ShortDefinitionConstrains;
