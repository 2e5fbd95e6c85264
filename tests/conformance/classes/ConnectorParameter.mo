// section: 4.7
// refuse: R072 9
model ConnectorParameter
  connector C
    Real e;
    flow Real f;
  end C;
  model A
    parameter C c;
  end A;
  A a;
end ConnectorParameter;
