within Lacuna.Components.Electrical;
model Inductor "Ideal inductor"
  extends Interfaces.TwoPin;
  parameter Types.Inductance L(final min=1e-12, start=1e-3) "Inductance";
equation
  L*der(i) = v;
  annotation(Documentation(info="<html>
<p>Law: <code>L der(i) = v</code>; <code>i</code> is a state. Inductors in series, or at a star point, share states: one
current less than there are inductors remains.</p>
</html>"));
end Inductor;
