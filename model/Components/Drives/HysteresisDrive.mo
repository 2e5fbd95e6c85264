within Lacuna.Components.Drives;
model HysteresisDrive "Current regulation within a band"
  extends Interfaces.PartialSwitchedDrive;
  parameter Types.Current band(final min=1e-6) = 0.5 "Half of the band's width";
protected
  Boolean raise(start=true, fixed=true) "The pair is driven to raise its current";
equation
  raise = if pre(raise) then not i_pair > i_set + band else i_pair < i_set - band;
  commutation.dir = if raise then 1 else -1;
  annotation(Documentation(info="<html>
<p>The voltage is reversed whenever the current leaves <code>i_set -+ band</code>. Its switching frequency follows
from bus
voltage, back-EMF and inductance, about <code>V/(8 L band)</code> at rest; a narrow band costs events.</p>
</html>"));
end HysteresisDrive;
