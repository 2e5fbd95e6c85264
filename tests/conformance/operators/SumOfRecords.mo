// section: 14
// refuse: R079 8
model SumOfRecords
  record R
    Real a;
  end R;
  R x = R(1);
  R y = x + x;
end SumOfRecords;
