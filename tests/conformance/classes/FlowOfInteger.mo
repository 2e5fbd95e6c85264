// section: 4.4.2.2
// refuse: R072 6
model FlowOfInteger
  connector C
    Real e;
    flow Integer f;
  end C;
  C c;
end FlowOfInteger;
