within Lacuna.Actuators;
model EccentricBldc "Pre-flight test of an actuator's motor: full-voltage step from rest, filtered phase currents"
  import Lacuna.Types.Eccentricity;
  parameter Types.PerUnit zeta(final min=0, final max=0.99) = 0 "Static eccentricity over air gap";
  parameter Eccentricity convention = Eccentricity.RotorAngle "How eccentricity modulates the back-EMF";
  parameter Types.Voltage V = 28 "Supply voltage";
  parameter Types.Resistance R(final min=0) = 2.13 "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9) = 720e-6 "Inductance of a phase";
  parameter Types.BackEmfConstant Ke = 0.12476 "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.Inertia J(final min=1e-12) = 2.5e-5 "Inertia of rotor and transmission";
  parameter Types.RotationalDamping b(final min=0) = 3e-5 "Viscous friction";
  parameter Types.Torque tau_c(final min=0) = 0.09357 "Dry friction";
  parameter Types.Frequency f_c(final min=1e-6) = 129.7 "Corner frequency of each current filter section";
  Components.Electrical.Bus supply(V=V) "Supply";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.Bridge bridge "Inverter";
  Components.Drives.SixStepCommutation commutation "Full voltage, six steps";
  Components.Drives.StarWinding winding(R=R, L=L, Ke=Ke, pp=pp, zeta=zeta, convention=convention) "Stator";
  Components.Mechanics.Inertia rotor(J=J, phi(start=0, fixed=true), w(start=0, fixed=true)) "Rotor";
  Components.Mechanics.ViscousFriction bearing(b=b) "Viscous friction";
  Components.Mechanics.DryFriction friction(tau_c=tau_c) "Dry friction";
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
  commutation.dir = 1;
  connect(winding.flange, rotor.flange_a);
  connect(rotor.flange_b, bearing.flange_a);
  connect(bearing.flange_b, friction.flange_a);
  filter[1].u = winding.a.i;
  filter[2].u = winding.b.i;
  filter[3].u = winding.c.i;
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>A step command so large that the position loop stays saturated: the drive is a six-step inverter at full voltage, the
control surface moves without aerodynamic load, and what is left of the actuator is its motor with friction. The three
phase currents, behind their filters, are what the prognostic method analyses.</p>
<p>The parameters are one consistent set for the published currents and speeds of Dalla Vedova et al., not the only one:
scaling <code>V, R, L, Ke, J, b, tau_c</code> by one factor leaves currents and speeds as they are.</p>
</html>"));
end EccentricBldc;
