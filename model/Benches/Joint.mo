within Lacuna.Benches;
model Joint "Shaft driven by a known torque"
  parameter Types.Inertia J(final min=1e-12) = 1e-4 "Inertia";
  parameter Types.RotationalDamping b(final min=0) = 1e-4 "Viscous friction";
  input Types.Torque tau "Driving torque";
  Components.Mechanics.TorqueSource drive "Drive";
  Components.Mechanics.Inertia shaft(J=J, phi(start=0, fixed=true), w(start=0, fixed=true)) "Shaft";
  Components.Mechanics.ViscousFriction bearing(b=b) "Bearings";
  Types.AngularVelocity w = shaft.w "Speed";
  Types.Angle theta = shaft.phi "Angle";
equation
  drive.u = tau;
  connect(drive.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
  annotation(experiment(StopTime=2, Tolerance=1e-6), Documentation(info="<html>
<pre>
J der(w) = tau - b w      shaft
der(theta) = w
</pre>
</html>"));
end Joint;
