within Lacuna.Interfaces;
partial model Rigid "Two flanges that turn as one"
  extends TwoFlanges;
  Types.Angle phi(stateSelect=StateSelect.prefer) "Absolute angle";
  Types.AngularVelocity w(stateSelect=StateSelect.prefer) "Absolute speed";
  Types.AngularAcceleration a "Absolute acceleration";
equation
  flange_a.phi = phi;
  flange_b.phi = phi;
  w = der(phi);
  a = der(w);
  annotation(Documentation(info="<html>
<p>Use it for inertias and for losses on a shaft. Either flange may stay unconnected.</p>
</html>"));
end Rigid;
