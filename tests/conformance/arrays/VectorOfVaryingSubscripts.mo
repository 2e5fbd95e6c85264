// section: 10.5
// value: y[1] at 0.25 = 0.25, y[2] at 0.25 = 1.25, y[1] = 2, y[2] = 5, c[1] at 0.25 = 0.25, c[1] = 2, c[2] = 3, s[1].a = 2, s[1].b = 20
// value: A[1,1] at 0 = 2, A[1,2] at 0 = 1, A[2,1] at 0 = 5, A[1,1] = 5, A[2,2] = 5
model VectorOfVaryingSubscripts
  record R
    Real a;
    Real b;
  end R;
  model Source
    parameter Real p = 1;
    Real x = p*time;
  end Source;
  Integer k[2] = {if time > 0.5 then 2 else 1, 3};
  Real v[3] = {1, 2, 5}*time;
  Real y[2] = v[k];
  Source source[3](p = {1, 2, 3});
  Real c[2] = source[k].x;
  R r[3] = {R(1, 10), R(2, 20), R(3, 30)};
  R s[2] = r[k];
  Real M[2, 2] = {{1, 2}, {4, 5}};
  Real A[2, 2] = M[{k[1], 2}, {2, k[1]}];
end VectorOfVaryingSubscripts;
