within Lacuna.Benches;
model DcServo "Voltage-driven DC motor with an inertia"
  parameter Types.Resistance R(final min=0) = 3.5 "Armature resistance";
  parameter Types.Inductance L(final min=1e-9) = 3.3e-3 "Armature inductance";
  parameter Types.BackEmfConstant Ke = 0.03 "Back-EMF and torque constant";
  parameter Types.Inertia J(final min=1e-12) = 7e-6 "Inertia of rotor and load";
  parameter Types.RotationalDamping b(final min=0) = 2e-5 "Viscous friction";
  input Types.Voltage u "Voltage of the drive, within +-12 V";
  Components.Electrical.SignalVoltage drive "Drive";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.DcWinding winding(R=R, L=L, Ke=Ke) "Armature";
  Components.Mechanics.Inertia shaft(J=J, phi(start=0, fixed=true), w(start=0, fixed=true)) "Shaft";
  Components.Mechanics.ViscousFriction bearing(b=b) "Bearings";
  Types.Current i(start=0, fixed=true) = winding.i "Armature current";
  Types.AngularVelocity w = shaft.w "Speed";
  Types.Angle theta = shaft.phi "Angle";
equation
  drive.u = u;
  connect(drive.n, ground.p);
  connect(drive.p, winding.p);
  connect(drive.n, winding.n);
  connect(winding.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
  annotation(experiment(StopTime=2, Tolerance=1e-6), Documentation(info="<html>
<pre>
L der(i) = u - R i - Ke w      winding
J der(w) = Ke i - b w          shaft
der(theta) = w
</pre>
<p>Torques attach at <code>shaft.flange_b</code>, sources and resistances at the pins of <code>winding</code>.</p>
</html>"));
end DcServo;
