// section: 7.1.3
// refuse: R071 8
model RecordExtendsModel
  model A
    Real x = 1;
  end A;
  record R
    extends A;
  end R;
  R r;
end RecordExtendsModel;
