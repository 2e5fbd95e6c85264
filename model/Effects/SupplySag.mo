within Lacuna.Effects;
block SupplySag "Bus voltage falling with the current drawn"
  extends Lacuna.Interfaces.SISO(u(unit="V"), y(unit="V"));
  Lacuna.Interfaces.RealInput i(unit="A") "Current drawn";
  parameter Types.Resistance R_s(final min=0) = 0 "Source resistance";
  parameter Types.Voltage V_0(final min=1e-3) = 24 "Bus voltage without current";
equation
  y = u*(1 - R_s*u*i/(V_0*V_0));
  annotation(__Lacuna(effect="drive.supply_sag", attaches="signal", location="drive", neutral(R_s=0), starts(V_0={1}), relative(V_0="u"), fixed={"V_0"},
    signature="voltage missing under large currents at high voltage only",
    excitation="large currents at different voltages", reference="Mohan, Undeland, Robbins 2003"),
    Documentation(info="<html>
<p>A converter of duty <code>u/V_0</code> draws <code>u i/V_0</code> from a bus of source resistance <code>R_s</code>.</p>
</html>"));
end SupplySag;
