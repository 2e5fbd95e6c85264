// section: 9.3
// refuse: R060 25
model QuantitiesThatDifferConnected "different quantities connected"
  connector C
    Real p(quantity="Pressure");
    flow Real f;
  end C;
  connector D
    Real p(quantity="Temperature");
    flow Real f;
  end D;
  model A
    C c;
  equation
    c.p = 1;
  end A;
  model B
    D c;
  equation
    c.f = 0;
  end B;
  A a;
  B b;
equation
  connect(a.c, b.c);
end QuantitiesThatDifferConnected;
