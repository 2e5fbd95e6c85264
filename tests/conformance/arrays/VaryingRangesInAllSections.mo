// section: 10.3.4.1
// value: y = 7, z = 3, p = 6, w = 2.5, s = 3
model VaryingRangesInAllSections "in algorithms, whens, asserts and initial equations"
  Real u[3] = {1, 2, 4};
  Integer k(start=1, fixed=true);
  discrete Real y(start=0, fixed=true);
  Real z, p;
  Real w(start=0);
  Real M[2, 3] = {{1, 2, 3}, {4, 5, 6}};
  Real s = sum(M[1, 1:k - 1]);
initial equation
  w = sum(u[1:k]) + 1.5;
equation
  der(w) = 0;
  assert(sum(u[1:k]) < 10, "too much");
  when sample(0.3, 0.5) then
    k = pre(k) + 1;
    y = sum(u[i] for i in 1:k);
  end when;
algorithm
  z := max(u[1:k - 1]) + 1;
  p := if k > 2 then sum(u[2:k]) else 0;
end VaryingRangesInAllSections;
