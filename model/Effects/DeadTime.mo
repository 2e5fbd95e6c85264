within Lacuna.Effects;
model DeadTime "Voltage lost against the sign of the current, which it stops at zero"
  extends Lacuna.Interfaces.TwoPin;
  parameter Types.Voltage V_d(final min=0) = 0 "Voltage lost";
  Integer mode(start=0, fixed=true) "Sign of the current; 0 while the loss holds it at zero";
protected
  constant Types.Inductance unitInductance = 1;
  constant Types.Current unitCurrent = 1;
  constant Types.Current i_small = 1e-10 "Smaller currents are zero";
  Types.Voltage v_hold "Voltage that holds the current at zero; zero while it flows";
  Types.Current i_held "Current while held: zero unless something else sets it";
  Types.Current i_along "Current in the sense in which it flows; positive while held";
equation
  0 = if mode == 0 then unitInductance*der(i) else v - mode*V_d;
  v_hold = if mode == 0 then v else 0;
  i_held = if mode == 0 then i else 0;
  i_along = if mode == 0 then unitCurrent else mode*i;
  mode = if pre(mode) == 0 then
      (if v_hold > V_d or i_held > i_small then 1 elseif v_hold < -V_d or i_held < -i_small then -1 else 0)
    elseif i_along < 0 then 0 else pre(mode);
  when mode == 0 then
    reinit(i, 0);
  end when;
  annotation(__Lacuna(effect="drive.dead_time", attaches="line", neutral(V_d=0),
    signature="constant voltage with the sign of the current; no current under small voltages",
    excitation="small currents of both signs", reference="Jeong, Park 1991"),
    Documentation(info="<html>
<p>The law of dry friction, for a current: the same modes as <code>Interfaces.PartialFriction</code>.</p>
</html>"));
end DeadTime;
