// section: 11.2.7
// value: n = 2, n at 0.5 = 1
model ElsewhenInAlgorithm
  Integer n(start=0, fixed=true);
algorithm
  when time > 0.32 then
    n := 1;
  elsewhen time > 0.72 then
    n := 2;
  end when;
end ElsewhenInAlgorithm;
