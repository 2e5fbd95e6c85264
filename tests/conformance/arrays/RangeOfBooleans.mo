// section: 10.4.3
// value: n = 2, x[1] = 0, x[2] = 1
model RangeOfBooleans
  Integer n = sum(1 for b in false:true);
  Real x[Boolean];
equation
  for b in Boolean loop
    x[b] = if b then 1 else 0;
  end for;
end RangeOfBooleans;
