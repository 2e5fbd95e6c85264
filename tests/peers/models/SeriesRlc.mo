model SeriesRlc "Series resonant circuit on a voltage step"
  parameter Real R(unit="Ohm") = 2 "Resistance";
  parameter Real L(unit="H") = 1e-3 "Inductance";
  parameter Real C(unit="F") = 1e-5 "Capacitance";
  parameter Real V(unit="V") = 10 "Supply";
  Real i(unit="A", start=0, fixed=true) "Current";
  Real v(unit="V", start=0, fixed=true) "Voltage of the capacitor";
equation
  L*der(i) = V - R*i - v;
  C*der(v) = i;
  annotation(experiment(StopTime=5e-3, Interval=1e-5));
end SeriesRlc;
