// section: 9.1.3
// refuse: R061 13
model BusAndConnector
  expandable connector EC
  end EC;
  connector C
    Real e;
    flow Real f;
  end C;
  EC ec;
  C c;
equation
  connect(c, ec);
end BusAndConnector;
