// section: 7.2.4
// value: c.s.a = 33
model WholeRecordWins
  record R
    parameter Real a;
  end R;
  record S
    parameter R r(a=33);
    parameter R s(a=5);
  end S;
  record T
    extends S(s=r);
  end T;
  T c;
end WholeRecordWins;
