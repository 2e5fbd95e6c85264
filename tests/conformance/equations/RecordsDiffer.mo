// section: 8.3.1
// refuse: R042 12
model RecordsDiffer
  record R
    Real a; Real b;
  end R;
  record S
    Real a; Real c;
  end S;
  R r(a=1, b=2); S s;
equation
  s = r;
end RecordsDiffer;
