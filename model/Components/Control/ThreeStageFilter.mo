within Lacuna.Components.Control;
block ThreeStageFilter "Three equal low-pass sections in series, as on a current signal"
  extends Interfaces.SISO;
  parameter Types.Frequency f_c(final min=1e-6, start=100) "Corner frequency of each section";
  FirstOrder stage1(f_c=f_c) "First section";
  FirstOrder stage2(f_c=f_c) "Second section";
  FirstOrder stage3(f_c=f_c) "Third section";
equation
  connect(u, stage1.u);
  connect(stage1.y, stage2.u);
  connect(stage2.y, stage3.u);
  connect(stage3.y, y);
  annotation(Documentation(info="<html>
<p>Transfer function <code>1/(1 + T s)^3</code>; at <code>f_c</code> -9 dB and -135 degrees. Attenuates noise and the
commutation's steps before a current is analysed or regulated.</p>
</html>"));
end ThreeStageFilter;
