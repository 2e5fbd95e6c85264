model Chain "n/2 bodies in a row, each held to the one before by a spring and a damper; the last is pulled"
  parameter Integer n = 100 "Number of states, two a body";
  final parameter Integer bodies = div(n, 2);
  Lacuna.Components.Mechanics.TranslationalFixed wall;
  Lacuna.Components.Mechanics.TranslationalSpringDamper link[bodies](each c=1e4, each d=1);
  Lacuna.Components.Mechanics.Mass body[bodies](each m=0.1, each s(start=0, fixed=true), each v(start=0, fixed=true));
  Lacuna.Components.Mechanics.ForceSource pull;
equation
  connect(wall.flange, link[1].flange_a);
  for k in 1:bodies loop
    connect(link[k].flange_b, body[k].flange_a);
  end for;
  for k in 1:bodies-1 loop
    connect(body[k].flange_b, link[k+1].flange_a);
  end for;
  connect(pull.flange, body[bodies].flange_b);
  pull.u = 1;
  annotation(experiment(StopTime=0.1, Tolerance=1e-6, Interval=1e-3));
end Chain;
