// section: 10.5.2
// value: s = 9, v[2] = 4
model SliceOfRecordArray "a field of a slice of records"
  record R
    Real a;
    Real b[2];
  end R;
  R r[3] = {R(i*time, {i, 2*i}*time) for i in 1:3};
  Real v[3] = r.b[2], s = sum(r[1:2].a) + r[3].b[2];
end SliceOfRecordArray;
