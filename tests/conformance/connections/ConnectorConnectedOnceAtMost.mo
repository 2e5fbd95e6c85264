// section: 18.8
// refuse: R060 9
model ConnectorConnectedOnceAtMost "a connector that is connected once at most"
  connector C
    Real p;
    flow Real f;
  end C;
  model A
    C c annotation(mayOnlyConnectOnce="one only");
  equation
    c.f = c.p;
  end A;
  model B
    C c;
  equation
    c.f = c.p - 1;
  end B;
  A a;
  B b1, b2;
equation
  connect(a.c, b1.c);
  connect(a.c, b2.c);
end ConnectorConnectedOnceAtMost;
