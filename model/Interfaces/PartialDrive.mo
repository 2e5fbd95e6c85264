within Lacuna.Interfaces;
partial model PartialDrive "Power drive electronics: makes the machine carry a reference current"
  extends PartialBridge;
  parameter Types.Current i_max(final min=0, start=10) "Current limit";
  RealInput i_ref(unit="A") "Reference current, positive for positive torque";
  RealInput i_phase[3](each unit="A") "Measured phase currents";
  IntegerInput sector "Sector of the rotor's electrical angle";
  Types.Current i_pair "Current through the driven pair of phases";
  Types.Current i_set "Reference after the current limit";
  Components.Drives.SixStepCommutation commutation "Which legs are driven";
  Components.Drives.PairCurrent pair "Current of the driven pair";
equation
  connect(sector, commutation.sector);
  connect(commutation.pattern, pair.pattern);
  connect(i_phase, pair.i);
  i_pair = pair.y;
  i_set = if i_ref > i_max then i_max elseif i_ref < -i_max then -i_max else i_ref;
  annotation(Documentation(info="<html>
<p>Base of the drives that regulate current by six steps. A drive adds the law that turns <code>i_set - i_pair</code>
into
commands of the legs.</p>
</html>"));
end PartialDrive;
