within Lacuna.Functions;
function trapezoid "Trapezoid of unit height with the period of a turn"
  input Types.Angle theta "Angle";
  output Types.PerUnit y "0 at 0, 1 from 30 to 150 degrees, 0 at 180, -1 from 210 to 330 degrees";
protected
  constant Real pi = 3.141592653589793;
  Types.Angle x "Angle within one turn";
algorithm
  x := mod(theta, 2*pi);
  if x < pi/6 then
    y := 6*x/pi;
  elseif x < 5*pi/6 then
    y := 1;
  elseif x < 7*pi/6 then
    y := 6*(pi - x)/pi;
  elseif x < 11*pi/6 then
    y := -1;
  else
    y := 6*(x - 2*pi)/pi;
  end if;
  annotation(Documentation(info="<html>
<p>Shape of the back-EMF of an ideal brushless machine. <code>Drives.StarWinding</code> uses the same shape, sector by
sector.</p>
</html>"));
end trapezoid;
