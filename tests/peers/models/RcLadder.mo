model RcLadder "Two RC sections from components with connectors"
  connector Pin
    Real v(unit="V") "Potential";
    flow Real i(unit="A") "Current into the component";
  end Pin;
  partial model TwoPin
    Pin p, n;
    Real v(unit="V") "Voltage from p to n";
    Real i(unit="A") "Current from p to n";
  equation
    v = p.v - n.v;
    i = p.i;
    p.i + n.i = 0;
  end TwoPin;
  model Resistor
    extends TwoPin;
    parameter Real R(unit="Ohm") = 1;
  equation
    v = R*i;
  end Resistor;
  model Capacitor
    extends TwoPin(v(start=0, fixed=true));
    parameter Real C(unit="F") = 1;
  equation
    C*der(v) = i;
  end Capacitor;
  model Source
    extends TwoPin;
    parameter Real V(unit="V") = 1;
  equation
    v = V;
  end Source;
  model Ground
    Pin p;
  equation
    p.v = 0;
  end Ground;
  Source source(V=5);
  Resistor r1(R=100), r2(R=220);
  Capacitor c1(C=1e-5), c2(C=4.7e-6);
  Ground ground;
equation
  connect(source.p, r1.p);
  connect(r1.n, c1.p);
  connect(r1.n, r2.p);
  connect(r2.n, c2.p);
  connect(source.n, ground.p);
  connect(c1.n, ground.p);
  connect(c2.n, ground.p);
  annotation(experiment(StopTime=0.01, Interval=1e-4));
end RcLadder;
