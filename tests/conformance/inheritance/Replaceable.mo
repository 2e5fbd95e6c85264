// section: 7.1.4
// refuse: R071 8
model Replaceable
  replaceable model A
    Real x = 1;
  end A;
  model B
    extends A;
  end B;
  B b;
end Replaceable;
