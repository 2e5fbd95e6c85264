within Lacuna.Effects;
model ImposedBand "Band brake whose slack is taken up at every reversal"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level of full sliding at high speed";
  parameter Types.Force F_s(final min=0) = 0 "Level of full sliding at low speed";
  parameter Types.Velocity v_s(final min=1e-9) = 0.05 "Speed over which the level falls";
  parameter Real F_x(unit="N/m2") = 0 "Growth of the level with the square of position";
  parameter Types.Length reach(final min=1e-9) = 1e-3 "Travel from the slack band to full sliding";
  Types.Length x(start=0, fixed=true) "Deflection from the slack band";
  Types.PerUnit share "Deflection over reach";
  Types.Force level "Level of full sliding at the present speed and position";
equation
  der(x) = noEvent(if x > reach and v > 0 or x < -reach and v < 0 then 0 else v);
  share = x/reach;
  level = F_c + (F_s - F_c)*exp(-noEvent(abs(v))/v_s) + F_x*s*s;
  f = level*noEvent(if x*v > 0 then share*abs(share) else share*share*share*abs(share));
  annotation(__Lacuna(effect="backlash", attaches="imposed", neutral(F_c=0, F_s=0, F_x=0),
    starts(reach={0.05, 0.2, 0.6}, v_s={0.3}), relative(reach="s", v_s="v"),
    signature="force that dies soon after a reversal, is near zero for some travel and then rises ever more steeply",
    excitation="reversals at several amplitudes and speeds", reference="Downey et al. 2016"),
    Documentation(info="<html>
<p>After a reversal the band slackens within a part of <code>reach</code> (fourth power of the deflection left); while it
winds up the other way, stiffness grows with the arc in contact, so the force grows with the square of the deflection, until
the drum slides.</p>
</html>"));
end ImposedBand;
