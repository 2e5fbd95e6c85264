within Lacuna.Interfaces;
partial model PartialSwitchedDrive "Drive that switches its pair of legs between the rails, with dead time"
  extends PartialDrive;
  parameter Types.Time t_dead(final min=0) = 1e-6 "Dead time of each leg";
  Components.Drives.Bridge bridge "Inverter";
  Components.Drives.DeadTime deadTime[3](each t_dead=t_dead) "Dead time of each leg";
equation
  connect(commutation.leg, deadTime.u);
  connect(deadTime.y, bridge.leg);
  connect(p, bridge.p);
  connect(n, bridge.n);
  connect(bridge.a, a);
  connect(bridge.b, b);
  connect(bridge.c, c);
  annotation(Documentation(info="<html>
<p>Bipolar (hard) chopping: the driven pair sees plus or minus the bus voltage, as <code>commutation.dir</code>
says.</p>
</html>"));
end PartialSwitchedDrive;
