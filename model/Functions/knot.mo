within Lacuna.Functions;
function knot "Element of a table, the first or last one beyond its ends"
  input Real xs[:] "Table";
  input Integer k "Number of the element, from 1";
  output Real x "Element";
algorithm
  x := xs[max(1, min(size(xs, 1), k))];
end knot;
