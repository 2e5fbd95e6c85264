// section: 8.3.1
// value: b.u = 2, b.v[2] = 4
model EquationOfRecords
  record R
    Real u;
    Real v[2];
  end R;
  R a, b;
equation
  a.u = 2*time;
  a.v = {3, 4};
  b = a;
end EquationOfRecords;
