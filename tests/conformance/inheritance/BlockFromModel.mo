// section: 7.1.3
// refuse: R071 8
model BlockFromModel
  model A
    Real x = 1;
  end A;
  block B
    extends A;
  end B;
  B b;
end BlockFromModel;
