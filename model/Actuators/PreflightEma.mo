within Lacuna.Actuators;
model PreflightEma "Pre-flight test of a whole actuator: saturated position loop, reducer with play, surface, transducer"
  parameter Types.PerUnit zeta(final min=0, final max=0.99) = 0 "Fault: static eccentricity over air gap";
  parameter Types.PerUnit short_a(final min=0, final max=0.99) = 0 "Fault: shorted turns of phase a";
  parameter Types.Angle backlash(final min=0) = 0.001 "Total play of the transmission, at the surface";
  parameter Types.Angle offset = 0 "Offset of the position transducer";
  parameter Types.Voltage V = 28 "Supply voltage";
  parameter Types.Resistance R(final min=0) = 2.13 "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9) = 720e-6 "Inductance of a phase";
  parameter Types.BackEmfConstant Ke = 0.12476 "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.Inertia J(final min=1e-12) = 2.3e-5 "Inertia of the rotor";
  parameter Types.Inertia Js(final min=1e-12) = 0.05 "Inertia of the surface";
  parameter Types.RotationalDamping b(final min=0) = 3e-5 "Viscous friction of the motor";
  parameter Types.Torque tau_c(final min=0) = 0.09357 "Dry friction of motor and hinge, at the motor";
  parameter Types.PerUnit hinge(final min=0, final max=1) = 0.3 "Share of the hinge in the dry friction";
  parameter Types.PerUnit N(final min=1) = 160 "Ratio of the reducer";
  parameter Types.RotationalStiffness k(final min=0) = 2e5 "Stiffness of the transmission, at the surface";
  parameter Types.RotationalDamping d(final min=0) = 20 "Damping of the transmission, at the surface";
  parameter Types.Angle command = 1 "Commanded angle of the surface: too far to be reached in the test";
  parameter Types.Frequency f_c(final min=1e-6) = 129.7 "Corner frequency of each current filter section";
  Components.Electrical.Bus supply(V=V) "Supply";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.Bridge bridge "Inverter";
  Components.Drives.SixStepCommutation commutation "Full voltage, six steps, in the sense of the position error";
  Components.Drives.StarWinding winding(R=R, L=L, Ke=Ke, pp=pp, zeta=zeta, shorted={short_a, 0, 0}) "Stator";
  Components.Mechanics.Inertia rotor(J=J, phi(start=0, fixed=true), w(start=0, fixed=true)) "Rotor";
  Components.Mechanics.ViscousFriction bearing(b=b) "Viscous friction of the motor";
  Components.Mechanics.DryFriction friction(tau_c=(1 - hinge)*tau_c) "Dry friction of the motor";
  Components.Mechanics.Gear gear(ratio=N) "Reducer";
  Components.Mechanics.Backlash transmission(c=k, d=d, b=backlash) "Elastic transmission with play";
  Components.Mechanics.Inertia surface(J=Js, phi(start=0, fixed=true), w(start=0, fixed=true)) "Control surface";
  Components.Mechanics.DryFriction hingeFriction(tau_c=hinge*tau_c*N) "Dry friction of the hinge";
  Components.Sensors.PositionTransducer transducer(offset=offset, f_c=300) "Position transducer of the surface";
  Components.Control.ThreeStageFilter filter[3](each f_c=f_c) "Filters of the currents of phases a, b, c";
initial equation
  winding.a.i = 0;
  winding.b.i = 0;
equation
  connect(supply.n, ground.p);
  connect(supply.p, bridge.p);
  connect(supply.n, bridge.n);
  connect(bridge.a, winding.pin_a);
  connect(bridge.b, winding.pin_b);
  connect(bridge.c, winding.pin_c);
  connect(winding.sector, commutation.sector);
  connect(commutation.leg, bridge.leg);
  commutation.dir = if command > transducer.y then 1 else -1;
  connect(winding.flange, rotor.flange_a);
  connect(rotor.flange_b, bearing.flange_a);
  connect(bearing.flange_b, friction.flange_a);
  connect(friction.flange_b, gear.flange_a);
  connect(gear.flange_b, transmission.flange_a);
  connect(transmission.flange_b, surface.flange_a);
  connect(surface.flange_b, hingeFriction.flange_a);
  connect(surface.flange_b, transducer.flange);
  filter[1].u = winding.a.i;
  filter[2].u = winding.b.i;
  filter[3].u = winding.c.i;
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>The test of <code>EccentricBldc</code> with what lies behind its motor: the command stays out of reach, so the position
loop asks for full voltage all the time; the rotor first crosses the play alone, then drives the surface.</p>
<p>Parameters of the motor are those of <code>EccentricBldc</code>, its dry friction is divided between motor and hinge, and
rotor and surface together have its inertia but for 2 %.</p>
</html>"));
end PreflightEma;
