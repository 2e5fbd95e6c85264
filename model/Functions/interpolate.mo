within Lacuna.Functions;
function interpolate "Linear interpolation in a table, constant beyond its ends"
  input Real xs[:] "Abscissae, increasing";
  input Real ys[size(xs, 1)] "Ordinates";
  input Real x "Abscissa";
  output Real y "Ordinate";
protected
  Integer low "Index of the knot at or below x";
  Integer high "Index of the knot above x";
  Integer middle "Index between them";
algorithm
  low := 1;
  high := size(xs, 1);
  if x <= xs[1] then
    y := ys[1];
  elseif x >= xs[high] then
    y := ys[high];
  else
    while high - low > 1 loop
      middle := div(low + high, 2);
      if xs[middle] <= x then
        low := middle;
      else
        high := middle;
      end if;
    end while;
    y := ys[low] + (ys[high] - ys[low])*(x - xs[low])/(xs[high] - xs[low]);
  end if;
  annotation(Documentation(info="<html>
<p>Bisection to the interval, then a straight line. Slopes jump at the knots without an event: a solver with error
control
finds them, one with a fixed step loses order there.</p>
</html>"));
end interpolate;
