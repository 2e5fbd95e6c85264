within Lacuna.Interfaces;
partial model PartialEma "Motor side of an actuator: control, drive, bus, machine with friction, supervision, energies"
  parameter Types.Voltage V(start=48) "Bus voltage";
  parameter Types.Resistance R_bus(final min=0) = 0.05 "Source resistance of the bus";
  parameter Types.Resistance R(final min=0, start=1) "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance of a phase";
  parameter Types.BackEmfConstant Ke(start=0.05) "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.Inertia Jm(final min=1e-12, start=1e-5) "Inertia of the motor";
  parameter Types.RotationalDamping bm(final min=0, start=1e-5) "Viscous friction of the motor";
  parameter Types.Torque tau_m(final min=0, start=0.01) "Dry friction of the motor, healthy";
  parameter Types.PerUnit mu(final min=0, final max=0.5) = 0.03 "Friction of the reducer over its load, healthy";
  parameter Types.PerUnit peak(final min=1) = 1.3 "Breakaway level of dry friction over its sliding level";
  parameter Types.Current i_limit(final min=0, start=10) "Current limit of the drive";
  parameter Types.Resistance Kp_i(final min=0, start=1) "Proportional gain of the current loop";
  parameter Real Ki_i(final min=0, final unit="Ohm/s", start=500) "Integral gain of the current loop";
  parameter Types.Frequency f_filter(final min=1e-6) = 500 "Corner frequency of the current filters' sections";
  parameter Types.PerUnit friction(final min=0) = 1 "Fault: dry friction as a multiple of the healthy one";
  parameter Types.PerUnit zeta(final min=0, final max=0.99) = 0 "Fault: static eccentricity over air gap";
  parameter Types.PerUnit short_a(final min=0, final max=0.99) = 0 "Fault: shorted turns of phase a";
  parameter Types.PerUnit short_b(final min=0, final max=0.99) = 0 "Fault: shorted turns of phase b";
  parameter Types.PerUnit short_c(final min=0, final max=0.99) = 0 "Fault: shorted turns of phase c";
  replaceable Components.Control.PositionController controller constrainedby PartialController
    "Actuator control electronics";
  replaceable Components.Drives.AveragedDrive drive(V=V, Kp=Kp_i, Ki=Ki_i, i_max=i_limit)
    constrainedby PartialDrive(i_max=i_limit) "Power drive electronics";
  Components.Electrical.Bus supply(V=V, R=R_bus) "Bus";
  Components.Electrical.Ground ground "Reference potential";
  Components.Drives.StarWinding winding(R=R, L=L, Ke=Ke, pp=pp, zeta=zeta, shorted={short_a, short_b, short_c})
    "Stator";
  Components.Mechanics.Inertia rotor(J=Jm, phi(start=0, fixed=true), w(start=0, fixed=true)) "Rotor";
  Components.Mechanics.ViscousFriction bearing(b=bm) "Viscous friction of the motor";
  Components.Mechanics.LoadFriction motorFriction(tau_c=friction*tau_m, mu=friction*mu, peak=peak)
    "Dry friction of motor and reducer";
  Components.Sensors.SpeedSensor speedSensor "Speed of the motor";
  Components.Control.ThreeStageFilter filter[3](each f_c=f_filter) "Filters of the currents of phases a, b, c";
  Components.Monitors.Supervisor followingError "Following error, with confirmation";
  Components.Monitors.Supervisor overCurrent "Current of the driven pair, with confirmation";
  Components.Monitors.Supervisor overSpeed "Speed of the motor, with confirmation";
  Components.Sensors.EnergyMeter supplied "Energy from the bus";
  Components.Sensors.EnergyMeter copper "Heat in windings and bus";
  Components.Sensors.EnergyMeter rubbed "Heat in bearings, friction and contacts";
  Components.Sensors.EnergyMeter switched "Loss of the inverter";
  Components.Sensors.EnergyMeter delivered "Work on the load";
  Types.Energy stored "Energy stored in currents, masses and springs";
  Types.Energy unaccounted "Supplied less lost, delivered and stored: zero, for a start at rest without load";
initial equation
  winding.a.i = 0;
  winding.b.i = 0;
equation
  connect(supply.n, ground.p);
  connect(supply.p, drive.p);
  connect(supply.n, drive.n);
  connect(drive.a, winding.pin_a);
  connect(drive.b, winding.pin_b);
  connect(drive.c, winding.pin_c);
  connect(winding.sector, drive.sector);
  connect(winding.flange, rotor.flange_a);
  connect(rotor.flange_a, speedSensor.flange);
  connect(rotor.flange_b, bearing.flange_a);
  connect(bearing.flange_b, motorFriction.flange_a);
  connect(speedSensor.w, controller.speed);
  connect(controller.i_ref, drive.i_ref);
  drive.i_phase[1] = winding.a.i;
  drive.i_phase[2] = winding.b.i;
  drive.i_phase[3] = winding.c.i;
  filter[1].u = winding.a.i;
  filter[2].u = winding.b.i;
  filter[3].u = winding.c.i;
  followingError.u = controller.command - controller.position;
  overCurrent.u = drive.i_pair;
  overSpeed.u = rotor.w;
  supplied.power = supply.power;
  copper.power = supply.loss + winding.loss;
  switched.power = drive.loss;
  unaccounted = supplied.E - copper.E - rubbed.E - switched.E - delivered.E - stored;
  annotation(Documentation(info="<html>
<p>Everything of an electromechanical actuator up to the output of its motor, <code>motorFriction.flange_b</code>. An
actuator
adds the transmission, the output, its load and transducer, and the energies <code>rubbed.power</code>,
<code>delivered.power</code> and <code>stored</code>. Controller and drive can be redeclared: continuous or sampled
control,
averaged or switched current regulation.</p>
<p>Fault parameters run from healthy (<code>friction = 1</code>, all others 0) to failed.</p>
</html>"));
end PartialEma;
