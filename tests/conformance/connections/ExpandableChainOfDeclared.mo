// section: 9.1.3
// value: first.y = 3, last.y = 3
model ExpandableChainOfDeclared "What one bus of a chain uses, all have, also where it is declared in them"
  expandable connector Bus
    Real a;
    Real unused;
  end Bus;
  connector Output = output Real;
  connector Input = input Real;
  model Reader
    Bus bus;
    Input u;
    Real y = u;
  equation
    connect(bus.a, u);
  end Reader;
  model Relay
    Bus bus;
  end Relay;
  model Writer
    Bus bus;
    Output y = 3;
  equation
    connect(y, bus.a);
  end Writer;
  Reader first;
  Relay x;
  Relay y;
  Relay z;
  Reader last;
  Writer writer;
equation
  connect(y.bus, z.bus);
  connect(x.bus, y.bus);
  connect(first.bus, x.bus);
  connect(z.bus, writer.bus);
  connect(last.bus, writer.bus);
end ExpandableChainOfDeclared;
