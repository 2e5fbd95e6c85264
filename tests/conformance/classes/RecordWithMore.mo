// section: 6.4
// refuse: R041 11
model RecordWithMore
  record R
    Real a;
  end R;
  record S
    Real a;
    Real b;
  end S;
  R r = S(1, 2);
end RecordWithMore;
