// section: 4.7
// refuse: R070 5
model ConnectorInner
  connector C
    inner Real e;
    flow Real f;
  end C;
  C c;
end ConnectorInner;
