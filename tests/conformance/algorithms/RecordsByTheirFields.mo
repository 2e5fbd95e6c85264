// section: 11.2.1
// value: q.a = 2, q.b = 1, r.x = 1, r.k = 2, s.x = 1
model RecordsByTheirFields "Records are assigned field by field, by name; constants stay"
  record S
    Real b;
    Real a;
  end S;
  record Q
    Real a;
    Real b;
  end Q;
  record R
    Real x;
    final constant Real k = 2;
  end R;
  S p;
  Q q;
  R r, s;
algorithm
  p := S(1, 2);
  q := p;
  r := R(time);
  s := r;
end RecordsByTheirFields;
