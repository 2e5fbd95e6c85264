// section: 3.6.7
// refuse: R070 5
model TimeInRecord
  record R
    Real x = time;
  end R;
  R r;
end TimeInRecord;
