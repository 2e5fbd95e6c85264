// section: 4.7
// refuse: R070 5
connector RC = Real;
block B
  RC u;
end B;
model ConnectorOfABlockUndirected
  B b;
equation
  b.u = 2;
end ConnectorOfABlockUndirected;
