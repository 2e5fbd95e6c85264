// section: 9.1
// refuse: R061 10
model ElementsOfConnectorsConnected "an element of a connector that is no connector"
  connector C
    Real p;
    flow Real f;
  end C;
  C c, d;
equation
  connect(c.p, d.p);
end ElementsOfConnectorsConnected;
