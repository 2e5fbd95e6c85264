// section: 10.5.1
// value: q[1] = 1, q[2] = 1, q[3] = 2, q[4] = 9, r[1] = 3, r[2] = 2, r[3] = 1, r[4] = 0, s[1] = 7, s[2] = 0, s[3] = 4
model AssignedVaryingSlicesOverlap "a shift, a reversal, fills and comprehensions"
  function f
    input Real a[:];
    input Integer n;
    output Real y[4];
    output Real r[4];
    output Real s[4];
  algorithm
    y := a;
    y[2:n] := y[1:n - 1];
    r := zeros(4);
    r[1:n] := {n - i + 1 for i in 1:n};
    s := a;
    s[1:n - 1] := zeros(n - 1);
    s[1:1] := fill(7, n - 2);
    s[n:n] := {4};
  end f;
  Integer n(start=3, fixed=true);
  Real q[4], r[4], s[4];
equation
  (q, r, s) = f({1, 2, 3, 9}, n);
  when time > 2 then
    n = 2;
  end when;
end AssignedVaryingSlicesOverlap;
