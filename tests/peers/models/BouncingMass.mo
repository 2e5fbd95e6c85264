model BouncingMass "A mass dropped on a plate that returns part of its speed"
  parameter Real g(unit="m/s2") = 9.81 "Gravity";
  parameter Real e(unit="1") = 0.8 "Restitution";
  Real h(unit="m", start=1, fixed=true) "Height";
  Real v(unit="m/s", start=0, fixed=true) "Speed upwards";
equation
  der(h) = v;
  der(v) = -g;
  when h < 0 then
    reinit(v, -e*pre(v));
  end when;
  annotation(experiment(StopTime=2, Interval=0.01));
end BouncingMass;
