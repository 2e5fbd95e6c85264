// section: 4.7
// refuse: R071 6
model OperatorRecordExtended
  operator record A Real x; end A;
  operator record B
    extends A;
  end B;
  B b;
equation
  b.x = 1;
end OperatorRecordExtended;
