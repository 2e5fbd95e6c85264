// section: 7.1.3
// refuse: R071 9
model RecordFromConnector
  connector C
    Real e;
    flow Real f;
  end C;
  record R
    extends C;
  end R;
  R r(e=1, f=2);
end RecordFromConnector;
