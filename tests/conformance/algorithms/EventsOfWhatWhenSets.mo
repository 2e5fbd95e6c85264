// section: 11.1
// value: d = 10, y = 10, y at 0.45 = 1, k at 0.5 = 3, k = 4
model EventsOfWhatWhenSets "functions that jump, of what the same algorithm sets at events"
  Integer d(start = 0, fixed = true), y(start = 0, fixed = true);
  Integer n(start = 0, fixed = true), k(start = 2, fixed = true);
algorithm
  when sample(0.1, 0.1) then
    d := d + 1;
  end when;
  y := integer(d*time + 1e-9);
  when time > 0.4 then
    n := 3;
  end when;
  k := mod(n + (if time > 0.52 then 1 else 0), 13);
end EventsOfWhatWhenSets;
