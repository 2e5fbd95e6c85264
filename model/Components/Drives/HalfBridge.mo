within Lacuna.Components.Drives;
model HalfBridge "One leg of an inverter: two ideal switches with ideal diodes"
  extends Interfaces.PartialLeg;
  Interfaces.IntegerInput u "1: upper switch closed, -1: lower switch closed, 0: both open";
equation
  driven = u <> 0;
  share = if u > 0 then 1 else 0;
  annotation(Documentation(info="<html>
<p>A closed switch joins the terminal to its rail. Lossless.</p>
</html>"));
end HalfBridge;
