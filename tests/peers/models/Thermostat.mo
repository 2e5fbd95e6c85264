model Thermostat "A heated room between two switching temperatures"
  parameter Real C(unit="J/K") = 1e3 "Heat capacity";
  parameter Real G(unit="W/K") = 10 "Loss";
  parameter Real P(unit="W") = 300 "Heater";
  parameter Real T_low(unit="K") = 292 "Switches on";
  parameter Real T_high(unit="K") = 294 "Switches off";
  parameter Real T_out(unit="K") = 275 "Outside";
  Real T(unit="K", start=290, fixed=true) "Room";
  Integer on(start=1, fixed=true) "Heater is on";
equation
  C*der(T) = on*P - G*(T - T_out);
algorithm
  when T > T_high then
    on := 0;
  elsewhen T < T_low then
    on := 1;
  end when;
  annotation(experiment(StopTime=300, Interval=1));
end Thermostat;
