// section: 3.8
// value: x = 5
model AlternativeOfAnEmptyArray
  parameter Integer n = 0;
  parameter Real t[n];
  parameter Real x = if n > 0 then t[1] else 5;
end AlternativeOfAnEmptyArray;
