// section: 4.7
// refuse: R070 6
model RecordWithEquation
  record R
    Real x;
  equation
    x = 1;
  end R;
  R r;
end RecordWithEquation;
