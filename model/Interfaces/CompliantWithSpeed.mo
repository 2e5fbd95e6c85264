within Lacuna.Interfaces;
partial model CompliantWithSpeed "Two flanges joined by a torque that depends on relative angle and speed"
  extends Compliant;
  Types.AngularVelocity w_rel "Speed of flange_b relative to flange_a";
equation
  w_rel = der(phi_rel);
  annotation(Documentation(info="<html>
<p>Use it for dampers, spring-dampers and contacts.</p>
</html>"));
end CompliantWithSpeed;
