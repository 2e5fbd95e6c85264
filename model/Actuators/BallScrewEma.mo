within Lacuna.Actuators;
model BallScrewEma "Linear actuator: another motor, a light reducer and a ball screw that moves a mass"
  extends Interfaces.PartialEma(
    V=270, R_bus=0.2, R=1.6, L=2.2e-3, Ke=0.21, pp=4, Jm=1.1e-4, bm=1e-4, tau_m=0.06, mu=0.04,
    i_limit=18, Kp_i=12, Ki_i=4000,
    controller(N=N, Kp=20, w_max=420, Kw=0.08, Ki=1, i_max=15),
    followingError(limit=12, t_confirm=0.2),
    overCurrent(limit=17, t_confirm=0.1), overSpeed(limit=470, t_confirm=0.05));
  parameter Types.PerUnit N(final min=0.1) = 2.5 "Ratio of the reducer";
  parameter Types.Length lead = 5e-3 "Travel of the screw in one turn";
  parameter Types.Stiffness c(final min=0) = 4e7 "Stiffness of screw, nut and bearings";
  parameter Types.Damping d(final min=0) = 2e4 "Damping of screw, nut and bearings";
  parameter Types.Mass m(final min=1e-6) = 60 "Mass of ram and load";
  parameter Types.Inertia Js(final min=1e-12) = 2e-4 "Inertia of the screw";
  parameter Types.Angle backlash(final min=0) = 0 "Fault: play of the reducer, at the screw";
  parameter Types.Length offset = 0 "Fault: offset of the position transducer";
  parameter Types.Length travel = 0.06 "Travel to either end stop";
  replaceable Components.Sources.Step command(height=0.02, t_start=0.05) constrainedby Interfaces.Source
    "Commanded position, m";
  replaceable Components.Sources.Constant load(k=-2000) constrainedby Interfaces.Source "Force on the ram, N";
  Components.Mechanics.Gear gear(ratio=N) "Reducer";
  Components.Mechanics.Backlash mesh(c=2e4, d=2, b=backlash) "Reducer's teeth";
  Components.Mechanics.Inertia screwInertia(J=Js, phi(start=0, fixed=true), w(start=0, fixed=true)) "Screw";
  Components.Mechanics.EndStops stops(phi_max=travel/screw.h, c=5e3, lambda=0.01) "End stops, at the screw";
  Components.Mechanics.BallScrew screw(lead=lead) "Ball screw";
  Components.Mechanics.TranslationalSpringDamper nut(c=c, d=d) "Compliance of screw and nut";
  Components.Mechanics.Mass ram(m=m, s(start=0, fixed=true), v(start=0, fixed=true)) "Ram and load";
  Components.Mechanics.ForceSource force "External force";
equation
  controller.command = command.y/screw.h;
  controller.position = (ram.s + offset)/screw.h;
  force.u = load.y;
  connect(motorFriction.flange_b, gear.flange_a);
  connect(gear.flange_b, mesh.flange_a);
  connect(mesh.flange_b, screwInertia.flange_a);
  connect(screwInertia.flange_b, stops.flange_a);
  connect(stops.flange_b, screw.flange_a);
  connect(screw.flange_b, nut.flange_a);
  connect(nut.flange_b, ram.flange_a);
  connect(ram.flange_b, force.flange);
  rubbed.power = bearing.loss + motorFriction.loss + mesh.loss + stops.loss + nut.loss;
  delivered.power = -force.power;
  stored = winding.stored + rotor.stored + mesh.stored + screwInertia.stored + stops.stored + nut.stored + ram.stored;
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>A 270 V linear actuator from the same components as <code>FlightControlEma</code>: parameters and a ball screw make
it
another machine. Position is controlled at the ram and expressed as the angle of the screw.</p>
</html>"));
end BallScrewEma;
