model Winch "A DC motor lifts a load; a brake holds it until the voltage comes"
  input Real u(unit="V") "Voltage of the drive";
  parameter Real R(unit="Ohm", min=0) = 1.2 "Armature resistance";
  parameter Real L(unit="H", min=1e-9) = 2e-3 "Armature inductance";
  parameter Real Ke(unit="N.m/A") = 0.08 "Back-EMF and torque constant";
  parameter Real J(unit="kg.m2", min=1e-12) = 4e-4 "Inertia of motor, gear and drum, at the motor";
  parameter Real n = 20 "Gear ratio";
  parameter Real r(unit="m", min=0) = 0.05 "Radius of the drum";
  parameter Real m(unit="kg", min=0) = 12 "Load";
  parameter Real b(unit="N.m.s/rad", min=0) = 1e-4 "Viscous friction, at the motor";
  parameter Real g(unit="m/s2") = 9.81 "Gravity";
  parameter Real u_on(unit="V") = 1 "Voltage at which the brake opens";
  Real i(unit="A", start=0, fixed=true) "Armature current";
  Real w(unit="rad/s", start=0, fixed=true) "Speed of the motor";
  Real h(unit="m", start=0, fixed=true) "Height of the load";
  Boolean held(start=true, fixed=true) "The brake is closed";
equation
  held = abs(u) < u_on;
  L*der(i) = u - R*i - Ke*w;
  (J + m*(r/n)^2)*der(w) = if held then 0 else Ke*i - b*w - m*g*r/n;
  der(h) = r/n*w;
  when held then
    reinit(w, 0);
  end when;
  annotation(experiment(StopTime=3, Tolerance=1e-6));
end Winch;
