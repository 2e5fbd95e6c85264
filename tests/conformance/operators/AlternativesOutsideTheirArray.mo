// section: 3.6.5
// value: x = 6
model AlternativesOutsideTheirArray
  parameter Integer n = 2;
  parameter Real t[n] = {1, 2};
  Real x = if n > 2 then t[3] elseif n > 3 then t[4] else 6;
end AlternativesOutsideTheirArray;
