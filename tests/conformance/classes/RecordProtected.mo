// section: 4.7
// refuse: R070 6
model RecordProtected
  record R
  protected
    Real x = 1;
  end R;
  R r;
end RecordProtected;
