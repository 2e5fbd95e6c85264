within Lacuna.Benches;
model BldcDrive "Three-phase trapezoidal machine in six-step operation at the full voltage of a bus"
  parameter Types.Resistance R(final min=0) = 2.13 "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9) = 0.72e-3 "Inductance of a phase";
  parameter Types.BackEmfConstant Ke = 0.12476 "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.Inertia J(final min=1e-12) = 2.5e-5 "Inertia of the rotor";
  parameter Types.RotationalDamping b(final min=0) = 3e-5 "Viscous friction";
  parameter Types.Torque tau_c(final min=0) = 0.09357 "Dry friction";
  input Types.Voltage v_bus "Voltage of the bus";
  input Types.PerUnit dir "Commutation direction, 1 or -1";
  Components.Electrical.SignalVoltage bus "Bus";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.Bridge bridge "Inverter";
  Components.Drives.SixStepCommutation commutation "Six steps at full voltage";
  Components.Drives.StarWinding winding(R=R, L=L, Ke=Ke, pp=pp) "Stator";
  Components.Mechanics.Inertia shaft(J=J, phi(start=0, fixed=true), w(start=0, fixed=true)) "Rotor";
  Components.Mechanics.ViscousFriction bearing(b=b) "Viscous friction";
  Components.Mechanics.DryFriction friction(tau_c=tau_c) "Dry friction";
  Types.Current ia(start=0, fixed=true) = winding.a.i "Current into phase a";
  Types.Current ib(start=0, fixed=true) = winding.b.i "Current into phase b";
  Types.Current ic = winding.c.i "Current into phase c";
  Types.AngularVelocity w = shaft.w "Speed";
  Types.Angle theta = shaft.phi "Angle";
equation
  bus.u = noEvent(max(v_bus, 0));
  commutation.dir = dir;
  connect(bus.n, ground.p);
  connect(bus.p, bridge.p);
  connect(bus.n, bridge.n);
  connect(bridge.a, winding.pin_a);
  connect(bridge.b, winding.pin_b);
  connect(bridge.c, winding.pin_c);
  connect(winding.sector, commutation.sector);
  connect(commutation.leg, bridge.leg);
  connect(winding.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
  connect(bearing.flange_b, friction.flange_a);
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<pre>
L der(i_x) = v_x - v_n - R i_x - k_x w,  k_x = Ke trap(pp theta - 120 deg n_x)      winding.a, .b, .c
J der(w)   = ka ia + kb ib + kc ic - b w - T_f                                      shaft
T_f        = tau_c sign(w) while it turns; at rest whatever in [-tau_c, tau_c] keeps it there
der(theta) = w
</pre>
<p>Two legs are switched by the rotor's sector and by <code>dir</code>, the third has only its diodes
(<code>bridge</code>). A
bus at zero is a short circuit of the three phases; the diodes would short a negative one, which is taken as zero.</p>
</html>"));
end BldcDrive;
