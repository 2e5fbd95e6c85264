within Lacuna.Components.Control;
block Limiter "Saturation"
  extends Interfaces.SISO;
  parameter Real y_max(start=1) "Upper limit";
  parameter Real y_min = -y_max "Lower limit";
equation
  assert(y_min <= y_max, "Limiter: y_min must not exceed y_max");
  y = if u > y_max then y_max elseif u < y_min then y_min else u;
  annotation(Documentation(info="<html>
<p>Law: <code>y = min(max(u, y_min), y_max)</code>; the corners are events.</p>
</html>"));
end Limiter;
