// section: 11.2.1.1
// value: y[1] at 0 = 2, y[2] at 0 = 3, y[1] = 3, y[2] = 2, z[1] at 0 = 30, z[3] at 0 = 10, z[1] = 10, z[2] = 30, z[3] = 20
// value: n[1] at 0.5 = 2, n[2] at 0.5 = 1, n[1] = 3, n[2] = 1, n[3] = 2, d[1] = 0, d[2] = 9
model ElementsByVaryingSubscripts "The later of two subscripts that are the same counts"
  Integer k[2] = if time > 0.5 then {2, 1} else {1, 2};
  Real y[2];
  Real z[3];
  Real d[2];
  Integer n[3](start = {1, 2, 3}, each fixed = true);
  Integer j(start = 1, fixed = true);
algorithm
  y := zeros(2);
  y[k] := {2, 3};
  z := {10, 20, 30};
  z[{k[1], 3}] := z[{3, k[1]}];
  d := zeros(2);
  d[{k[1], 2}] := {8, 9};
algorithm
  when {time > 0.25, time > 0.75} then
    j := j + 1;
    n[{j, 1}] := n[{1, j}];
  end when;
end ElementsByVaryingSubscripts;
