// section: 3.7.4.6
// refuse: R050 9
model CardinalityOfAnArray "cardinality of an array of connectors"
  connector C
    Real p;
    flow Real f;
  end C;
  C c[2];
  Real x = cardinality(c);
equation
  c[1].p = 1;
  c[2].p = 1;
end CardinalityOfAnArray;
