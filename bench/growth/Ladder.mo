model Ladder "A line of n stages, each a series resistance and a capacitance to ground, behind a source"
  parameter Integer n = 100 "Number of stages";
  Lacuna.Components.Electrical.ConstantVoltage source(V=1);
  Lacuna.Components.Electrical.Ground ground;
  Lacuna.Components.Electrical.Resistor r[n](each R=100);
  Lacuna.Components.Electrical.Capacitor c[n](each C=1e-6, each v(start=0, fixed=true));
equation
  connect(source.n, ground.p);
  connect(source.p, r[1].p);
  for k in 1:n loop
    connect(r[k].n, c[k].p);
    connect(c[k].n, ground.p);
  end for;
  for k in 1:n-1 loop
    connect(r[k].n, r[k+1].p);
  end for;
  annotation(experiment(StopTime=0.01, Tolerance=1e-6, Interval=1e-4));
end Ladder;
