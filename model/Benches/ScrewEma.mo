within Lacuna.Benches;
model ScrewEma "Position servo: motor, reducer, elastic transmission and control surface"
  parameter Types.Resistance R(final min=0) = 2.1 "Winding resistance";
  parameter Types.Inductance L(final min=1e-9) = 0.7e-3 "Winding inductance";
  parameter Types.BackEmfConstant Ke = 0.075 "Back-EMF and torque constant";
  parameter Types.Inertia Jm(final min=1e-12) = 2.5e-5 "Inertia of the motor";
  parameter Types.RotationalDamping bm(final min=0) = 3e-5 "Viscous friction of the motor";
  parameter Types.PerUnit N(final min=1e-6) = 160 "Ratio of the reducer";
  parameter Types.RotationalStiffness k(final min=0) = 1e5 "Stiffness of the transmission, at the surface";
  parameter Types.RotationalDamping d(final min=0) = 12 "Damping of the transmission, at the surface";
  parameter Types.Inertia Js(final min=1e-12) = 0.9 "Inertia of the surface";
  parameter Types.RotationalDamping bs(final min=0) = 5 "Viscous friction of the surface";
  parameter Types.Voltage Vdc(final min=0) = 48 "Largest voltage of the drive";
  parameter Real Kp(final unit="1/s") = 18 "Gain of the position loop";
  parameter Types.AngularVelocity wmax(final min=0) = 550 "Largest reference speed of the motor";
  parameter Types.BackEmfConstant Kw = 0.35 "Proportional gain of the speed loop";
  parameter Real Ki(final unit="V/rad") = 6 "Integral gain of the speed loop";
  input Types.Angle theta_cmd "Commanded angle of the surface";
  input Types.Torque T_aero "Load on the surface, against positive angle";
  Components.Control.ServoController controller(N=N, Kp=Kp, wmax=wmax, Kw=Kw, Ki=Ki, Vdc=Vdc)
    "Position and speed loops";
  Components.Electrical.SignalVoltage drive "Power drive";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.DcWinding winding(R=R, L=L, Ke=Ke) "Winding";
  Components.Mechanics.Inertia shaft(J=Jm, phi(start=0, fixed=true), w(start=0, fixed=true)) "Motor shaft";
  Components.Mechanics.ViscousFriction motorBearing(b=bm) "Bearings of the motor";
  Components.Mechanics.Gear gear(ratio=N) "Reducer";
  Components.Mechanics.SpringDamper transmission(c=k, d=d) "Elastic transmission";
  Components.Mechanics.Inertia surface(J=Js, phi(start=0, fixed=true), w(start=0, fixed=true)) "Control surface";
  Components.Mechanics.ViscousFriction hinge(b=bs) "Hinge of the surface";
  Components.Mechanics.TorqueSource load "Aerodynamic load";
  Types.Voltage u = controller.u "Voltage of the drive";
  Types.Current i(start=0, fixed=true) = winding.i "Current";
  Types.AngularVelocity wm = shaft.w "Speed of the motor";
  Types.Angle thm = shaft.phi "Angle of the motor";
  Types.AngularVelocity ws = surface.w "Speed of the surface";
  Types.Angle ths = surface.phi "Angle of the surface";
  Types.Angle xi = controller.xi "Integral of the speed error";
  Types.Torque Ts = -transmission.tau "Torque on the surface";
equation
  controller.command = theta_cmd;
  controller.position = surface.phi;
  controller.speed = shaft.w;
  drive.u = controller.u;
  load.u = -T_aero;
  connect(drive.n, ground.p);
  connect(drive.p, winding.p);
  connect(drive.n, winding.n);
  connect(winding.flange, shaft.flange_a);
  connect(shaft.flange_b, motorBearing.flange_a);
  connect(motorBearing.flange_b, gear.flange_a);
  connect(gear.flange_b, transmission.flange_a);
  connect(transmission.flange_b, surface.flange_a);
  connect(surface.flange_b, hinge.flange_a);
  connect(hinge.flange_b, load.flange);
  annotation(experiment(StopTime=2, Tolerance=1e-6), Documentation(info="<html>
<pre>
L der(i)   = u - R i - Ke wm                                  winding
Jm der(wm) = Ke i - bm wm - Ts/N                              shaft
Ts         = k (thm/N - ths) + d (wm/N - ws)                  transmission
Js der(ws) = Ts - bs ws - T_aero                              surface
u          = limit(Kw (wref - wm) + Ki xi, Vdc)               drive
wref       = limit(Kp N (theta_cmd - ths), wmax)
der(xi)    = wref - wm, held while u is at its limit and would be driven further into it
</pre>
</html>"));
end ScrewEma;
