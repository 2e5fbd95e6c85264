// section: 4.7
// refuse: R070 8
model RecordOfAModel "elements of a record are of records and types"
  model M
    Real x = time;
  end M;
  record R
    M m;
  end R;
  R r;
end RecordOfAModel;
