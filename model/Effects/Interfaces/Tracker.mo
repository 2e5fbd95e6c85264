within Lacuna.Effects.Interfaces;
model Tracker "Torque that draws a shaft towards a recorded motion"
  Lacuna.Interfaces.Flange_b flange "Shaft";
  Lacuna.Interfaces.RealInput phi(unit="rad") "Recorded angle";
  Lacuna.Interfaces.RealInput w(unit="rad/s") "Recorded speed";
  parameter Types.RotationalStiffness c = 0 "Stiffness";
  parameter Types.RotationalDamping d = 0 "Damping";
  Types.Torque tau "Torque on the shaft: what the model lacks at this place, within the bandwidth of c and d";
equation
  tau = c*(phi - flange.phi) + d*(w - der(flange.phi));
  flange.tau = -tau;
  annotation(Documentation(info="<html>
<p>With a stiff tracker the parts of the machine beyond the shaft see the recorded motion, so they can be fitted alone;
its torque is the effort that the model leaves unexplained. Without stiffness it is not there.</p>
</html>"));
end Tracker;
