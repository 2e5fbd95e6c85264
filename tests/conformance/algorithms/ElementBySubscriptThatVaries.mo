// section: 11.2.1
// value: a[1] = 0, a[2] = 9
model ElementBySubscriptThatVaries
  Real a[3];
  Integer k = if time > 0.5 then 2 else 1;
algorithm
  a := zeros(3);
  a[k] := 9;
end ElementBySubscriptThatVaries;
