within Lacuna.Functions;
function interval "Interval of a table in which a value lies"
  input Real xs[:] "Knots, increasing";
  input Real x "Value";
  output Integer k "Number of the last knot at or below x; 0 before the first";
protected
  Integer high "Number of a knot above x, or one more than there are";
  Integer middle "Number between";
algorithm
  k := 0;
  high := size(xs, 1) + 1;
  while high - k > 1 loop
    middle := div(k + high, 2);
    if xs[middle] <= x then
      k := middle;
    else
      high := middle;
    end if;
  end while;
end interval;
