within Lacuna.Components.Mechanics;
model BallScrew "Ideal screw: rotation to translation, without loss"
  parameter Types.Length lead(start=5e-3) "Travel in one turn; negative: left-hand thread";
  Interfaces.Flange_a flange_a "Screw";
  Interfaces.TranslationalFlange_b flange_b "Nut";
  final parameter Types.Lead h = lead/(2*pi) "Travel for one radian";
protected
  constant Real pi = 3.141592653589793;
equation
  flange_b.s = h*flange_a.phi;
  0 = flange_a.tau + h*flange_b.f;
  annotation(Documentation(info="<html>
<p>Laws: <code>s = lead/(2 pi) phi</code>, <code>tau = -lead/(2 pi) f</code>. Friction of the screw is a
<code>LoadFriction</code> on its shaft.</p>
</html>"));
end BallScrew;
