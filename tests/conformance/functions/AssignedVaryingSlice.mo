// section: 10.5.1
// value: y = 6, z = 4
model AssignedVaryingSlice "slice assignment in functions with varying bounds"
  function f
    input Real a[:];
    input Integer n;
    output Real y[size(a, 1)];
  algorithm
    y := a;
    y[1:n] := 2*a[1:n];
  end f;
  Integer n(start=1, fixed=true);
  Real q[3] = f({time, 1, 2}, n);
  Real y = sum(q), z = q[1] + q[2];
equation
  when time > 0.5 then
    n = 2;
  end when;
end AssignedVaryingSlice;
