within Lacuna.Benches;
model FlightControl "Whole flight control actuator: position, speed and current loops, three-phase machine, reducer and surface"
  parameter Types.Resistance R(final min=0) = 1.05 "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9) = 0.35e-3 "Inductance of a phase";
  parameter Types.BackEmfConstant Ke = 0.0375 "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.Inertia Jm(final min=1e-12) = 2.5e-5 "Inertia of the motor";
  parameter Types.RotationalDamping bm(final min=0) = 3e-5 "Viscous friction of the motor";
  parameter Types.Torque tau_m(final min=0) = 0.01 "Dry friction of the motor";
  parameter Types.PerUnit N(final min=1) = 160 "Ratio of the reducer";
  parameter Types.RotationalStiffness k(final min=0) = 1e5 "Stiffness of the transmission, at the surface";
  parameter Types.RotationalDamping d(final min=0) = 12 "Damping of the transmission, at the surface";
  parameter Types.Inertia Js(final min=1e-12) = 0.9 "Inertia of the surface";
  parameter Types.RotationalDamping bs(final min=0) = 5 "Viscous friction of the hinge";
  parameter Types.Voltage Vdc(final min=0) = 48 "Bus voltage";
  parameter Real Kp(final unit="1/s") = 18 "Gain of the position loop";
  parameter Types.AngularVelocity wmax(final min=0) = 550 "Largest reference speed of the motor";
  parameter Real Kw(final unit="A.s/rad") = 0.05 "Proportional gain of the speed loop";
  parameter Real Ki(final unit="A/rad") = 0.5 "Integral gain of the speed loop";
  parameter Types.Current i_max(final min=0) = 12 "Largest reference current";
  parameter Types.Resistance Kp_i(final min=0) = 1 "Proportional gain of the current loop";
  parameter Real Ki_i(final min=0, final unit="Ohm/s") = 500 "Integral gain of the current loop";
  input Types.Angle theta_cmd "Commanded angle of the surface";
  input Types.Torque T_aero "Load on the surface, against positive angle";
  Components.Control.PositionController controller(N=N, Kp=Kp, w_max=wmax, Kw=Kw, Ki=Ki, i_max=i_max, final onset=1e-4)
    "Position and speed loops";
  Components.Drives.AveragedDrive drive(V=Vdc, i_max=i_max, Kp=Kp_i, Ki=Ki_i, final onset=1e-4) "Current loop and inverter";
  Components.Electrical.SignalVoltage supply "Bus";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.StarWinding winding(R=R, L=L, Ke=Ke, pp=pp) "Stator";
  Components.Mechanics.Inertia shaft(J=Jm, phi(start=0, fixed=true), w(start=0, fixed=true)) "Rotor";
  Components.Mechanics.ViscousFriction motorBearing(b=bm) "Bearings of the motor";
  Components.Mechanics.DryFriction motorFriction(tau_c=tau_m) "Dry friction of the motor";
  Components.Mechanics.Gear gear(ratio=N) "Reducer";
  Components.Mechanics.SpringDamper transmission(c=k, d=d) "Elastic transmission";
  Components.Mechanics.Inertia surface(J=Js, phi(start=0, fixed=true), w(start=0, fixed=true)) "Control surface";
  Components.Mechanics.ViscousFriction hinge(b=bs) "Hinge of the surface";
  Components.Mechanics.TorqueSource load "Aerodynamic load";
  Types.Current ia(start=0, fixed=true) = winding.a.i "Current into phase a";
  Types.Current ib(start=0, fixed=true) = winding.b.i "Current into phase b";
  Types.Current ic = winding.c.i "Current into phase c";
  Types.AngularVelocity wm = shaft.w "Speed of the motor";
  Types.Angle thm = shaft.phi "Angle of the motor";
  Types.Angle ths = surface.phi "Angle of the surface";
equation
  supply.u = Vdc;
  load.u = -T_aero;
  controller.command = theta_cmd;
  controller.position = surface.phi;
  controller.speed = shaft.w;
  drive.i_phase[1] = winding.a.i;
  drive.i_phase[2] = winding.b.i;
  drive.i_phase[3] = winding.c.i;
  connect(controller.i_ref, drive.i_ref);
  connect(winding.sector, drive.sector);
  connect(supply.n, ground.p);
  connect(supply.p, drive.p);
  connect(supply.n, drive.n);
  connect(drive.a, winding.pin_a);
  connect(drive.b, winding.pin_b);
  connect(drive.c, winding.pin_c);
  connect(winding.flange, shaft.flange_a);
  connect(shaft.flange_b, motorBearing.flange_a);
  connect(motorBearing.flange_b, motorFriction.flange_a);
  connect(motorFriction.flange_b, gear.flange_a);
  connect(gear.flange_b, transmission.flange_a);
  connect(transmission.flange_b, surface.flange_a);
  connect(surface.flange_b, hinge.flange_a);
  connect(hinge.flange_b, load.flange);
  annotation(experiment(StopTime=2, Tolerance=1e-6), Documentation(info="<html>
<p>A healthy actuator as one believes in it: <code>BldcDrive</code>'s machine under current control, <code>ScrewEma</code>'s
mechanics, no play, no stops, no friction but the motor's. <code>Actuators.FlightControlEma</code> has all that this one has
not.</p>
<pre>
i_ref     = limit(Kw (wref - wm) + x, i_max); der(x) = Ki (wref - wm), held at the limit      controller
wref      = limit(Kp N (theta_cmd - ths), wmax)
v_pair    = limit(Kp_i (i_ref - i_pair) + y, Vdc); der(y) = Ki_i (i_ref - i_pair), held       drive
</pre>
</html>"));
end FlightControl;
