within Lacuna.Components.Control;
block Hysteresis "Two-level relay with a band"
  parameter Real u_low(start=-1) "Input below which the output is false";
  parameter Real u_high(start=1) "Input above which the output is true";
  parameter Boolean y_start = false "Output at the start, within the band";
  Interfaces.RealInput u "Input signal";
  Interfaces.BooleanOutput y(start=y_start, fixed=true) "Output signal";
equation
  assert(u_low < u_high, "Hysteresis: u_low must be below u_high");
  y = if pre(y) then not u < u_low else u > u_high;
  annotation(Documentation(info="<html>
<p>Keeps its output while the input is within the band, so it cannot chatter as a relay without a band does.</p>
</html>"));
end Hysteresis;
