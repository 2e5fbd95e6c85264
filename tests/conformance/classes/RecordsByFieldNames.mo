// section: 6.6
// value: s.a = 1, s.b = 2
model RecordsByFieldNames
  record R
    Real a;
    Real b;
  end R;
  record S
    Real b;
    Real a;
  end S;
  R r(a=1, b=2);
  S s = r;
end RecordsByFieldNames;
