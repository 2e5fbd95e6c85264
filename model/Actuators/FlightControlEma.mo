within Lacuna.Actuators;
model FlightControlEma "Position servo of a flight control surface: the whole closed loop with its progressive faults"
  extends Interfaces.PartialEma(
    V=48, R=1.05, L=0.35e-3, Ke=0.0375, Jm=2.5e-5, bm=3e-5, tau_m=0.01,
    i_limit=15, Kp_i=1.5, Ki_i=500,
    controller(N=N, Kp=18, w_max=550, Kw=0.05, Ki=0.5, i_max=12),
    followingError(limit=0.05, t_confirm=0.2),
    overCurrent(limit=14, t_confirm=0.1), overSpeed(limit=620, t_confirm=0.05));
  parameter Types.PerUnit N(final min=1) = 160 "Ratio of the reducer";
  parameter Types.RotationalStiffness k(final min=0) = 1e5 "Stiffness of the transmission, at the surface";
  parameter Types.RotationalDamping d(final min=0) = 12 "Damping of the transmission, at the surface";
  parameter Types.Inertia Js(final min=1e-12) = 0.9 "Inertia of the surface";
  parameter Types.RotationalDamping bs(final min=0) = 5 "Viscous friction of the hinge";
  parameter Types.Torque tau_s(final min=0) = 2 "Dry friction of the hinge, healthy";
  parameter Types.Angle travel(final min=0) = 0.45 "Travel to either end stop";
  parameter Types.RotationalStiffness c_aero = 30 "Hinge moment for one radian of deflection";
  parameter Types.Torque tau_aero = 0 "Constant hinge moment";
  parameter Types.Angle backlash(final min=0) = 0 "Fault: total play of the transmission, at the surface";
  parameter Types.Angle offset = 0 "Fault: offset of the position transducer";
  replaceable Components.Sources.Step command(height=0.1, t_start=0.05) constrainedby Interfaces.Source
    "Commanded angle of the surface, rad";
  replaceable Components.Sources.Constant gust constrainedby Interfaces.Source "Further hinge moment, N.m";
  Components.Mechanics.Gear gear(ratio=N) "Reducer";
  Components.Mechanics.Backlash transmission(c=k, d=d, b=backlash) "Elastic transmission with play";
  Components.Mechanics.Inertia surface(J=Js, phi(start=0, fixed=true), w(start=0, fixed=true)) "Control surface";
  Components.Mechanics.ViscousFriction hinge(b=bs) "Viscous friction of the hinge";
  Components.Mechanics.DryFriction hingeFriction(tau_c=friction*tau_s, peak=peak) "Dry friction of the hinge";
  Components.Mechanics.EndStops stops(phi_max=travel, c=2e5, lambda=0.5) "End stops";
  Components.Mechanics.HingeMoment aero(tau0=tau_aero, c=c_aero) "Aerodynamic load";
  Components.Sensors.PositionTransducer transducer(offset=offset, f_c=300) "Position transducer of the surface";
equation
  connect(command.y, controller.command);
  connect(gust.y, aero.u);
  connect(motorFriction.flange_b, gear.flange_a);
  connect(gear.flange_b, transmission.flange_a);
  connect(transmission.flange_b, surface.flange_a);
  connect(surface.flange_b, hinge.flange_a);
  connect(hinge.flange_b, hingeFriction.flange_a);
  connect(hingeFriction.flange_b, stops.flange_a);
  connect(stops.flange_b, aero.flange);
  connect(surface.flange_b, transducer.flange);
  connect(transducer.y, controller.position);
  rubbed.power = bearing.loss + motorFriction.loss + transmission.loss + hinge.loss + hingeFriction.loss + stops.loss;
  delivered.power = aero.delivered;
  stored = winding.stored + rotor.stored + transmission.stored + surface.stored + stops.stored;
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>Command, control electronics, drive, machine, two-mass mechanics with reducer, compliance, play, dry friction and
stops,
aerodynamic load, transducer and supervision: the block diagram of Dalla Vedova et al. in components. The default
variant has continuous control and an averaged drive; <code>Actuators.Scenarios</code> has others.</p>
</html>"));
end FlightControlEma;
