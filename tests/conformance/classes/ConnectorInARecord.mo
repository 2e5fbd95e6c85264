// section: 4.7
// refuse: R070 6
model ConnectorInARecord
  connector P = Real;
  record R
    P p;
  end R;
  R r;
equation
  r.p = 1;
end ConnectorInARecord;
