// section: 7.1.3
// refuse: R071 6
model TypeAndMore
  type T = Real[3];
  model B
    extends T;
    Real y = 1;
  end B;
  B b;
end TypeAndMore;
