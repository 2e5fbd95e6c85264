// section: 10.5
// value: y at 0.2 = 3, y = 7, q.v[2] = 8, q.a = 7
model RecordPickedByVaryingIndex
  record R
    Real a;
    Real v[2];
  end R;
  R r[2] = {R(3, {1, 2}), R(7, {4, 8})};
  Integer k(start = 1, fixed = true);
  R q = r[k];
  Real y = r[k].a;
equation
  when time > 0.5 then
    k = 2;
  end when;
end RecordPickedByVaryingIndex;
