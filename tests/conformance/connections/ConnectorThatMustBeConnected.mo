// section: 18.8
// refuse: R060 9
model ConnectorThatMustBeConnected "a connector that must be connected and is not"
  connector C
    Real p;
    flow Real f;
  end C;
  model A
    C c annotation(mustBeConnected="connect me");
  equation
    c.f = c.p;
  end A;
  A a;
end ConnectorThatMustBeConnected;
