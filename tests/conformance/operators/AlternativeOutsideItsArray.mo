// section: 3.6.5
// value: x = 5
model AlternativeOutsideItsArray
  parameter Integer k = 3;
  parameter Real t[2] = {1, 2};
  Real x = if k <= 2 then t[k] else 5;
end AlternativeOutsideItsArray;
