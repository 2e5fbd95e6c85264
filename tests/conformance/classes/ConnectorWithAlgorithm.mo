// section: 4.7
// refuse: R070 7
model ConnectorWithAlgorithm
  connector C
    Real e;
    flow Real f;
  algorithm
    e := 1;
  end C;
  C c;
end ConnectorWithAlgorithm;
