model LinearLoop "A bridge of resistors, an algebraic loop, charges an inductance"
  parameter Real R1(unit="Ohm") = 10, R2(unit="Ohm") = 22, R3(unit="Ohm") = 15, R4(unit="Ohm") = 47;
  parameter Real L(unit="H") = 0.1;
  parameter Real V(unit="V") = 12;
  Real va(unit="V") "Left middle of the bridge", vb(unit="V") "Right middle of the bridge";
  Real i(unit="A", start=0, fixed=true) "Through the inductance, from left to right";
equation
  (V - va)/R1 = va/R2 + i;
  (V - vb)/R3 + i = vb/R4;
  L*der(i) = va - vb;
  annotation(experiment(StopTime=0.05, Interval=1e-4));
end LinearLoop;
