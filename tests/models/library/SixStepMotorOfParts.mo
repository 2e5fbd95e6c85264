model SixStepMotorOfParts "T2 from parts of the Modelica Standard Library: windings in star, terminals, machine and shaft"
  import Modelica.Electrical.Analog;
  import Modelica.Blocks.Sources.RealExpression;
  parameter Integer pp = 2;
  parameter Modelica.Units.SI.Voltage V = 48;
  parameter Real Ke(unit="V.s/rad") = 0.075;
  constant Modelica.Units.SI.Angle width = Modelica.Constants.pi/3 "Electrical width of a sector";
  Analog.Basic.Ground ground;
  Analog.Sources.SignalVoltage terminal[3] "Potentials of the terminals";
  Analog.Basic.Resistor resistor[3](each R=2.1);
  Analog.Basic.Inductor inductor[3](each L=7e-4, i(each start=0, fixed={true, true, false}));
  Analog.Sources.SignalVoltage induced[3] "Back-EMF";
  Analog.Sensors.PotentialSensor star;
  Modelica.Mechanics.Rotational.Components.Inertia shaft(J=6e-5, phi(start=0, fixed=true), w(start=0, fixed=true));
  Modelica.Mechanics.Rotational.Components.Damper bearing(d=2e-4);
  Modelica.Mechanics.Rotational.Components.Fixed housing;
  Modelica.Mechanics.Rotational.Sources.Torque machine;
  RealExpression potential[3](y={
    if k < 2 then V elseif k == 3 or k == 4 then 0 else star.phi + induced[1].v,
    if k == 2 or k == 3 then V elseif k == 5 or k == 0 then 0 else star.phi + induced[2].v,
    if k > 3 then V elseif k == 1 or k == 2 then 0 else star.phi + induced[3].v});
  RealExpression emf[3](y=Ke*shaft.w*f);
  RealExpression torque(y=Ke*(f*inductor.i));
  Integer n(start=-1, fixed=true) "Commutations so far";
  Integer k "Sector, 0 to 5";
  Real s "Position in the sector, from -1 to 1";
  Real f[3] "Shapes of the back-EMF";
equation
  k = mod(n, 6);
  s = 2*(pp*shaft.phi - n*width)/width - 2;
  f[1] = if k < 2 then 1 elseif k == 2 then -s elseif k < 5 then -1 else s;
  f[2] = if k == 2 or k == 3 then 1 elseif k == 4 then -s elseif k == 1 then s else -1;
  f[3] = if k > 3 then 1 elseif k == 0 then -s elseif k == 3 then s else -1;
  when pp*shaft.phi > (pre(n) + 1.5)*width then
    n = pre(n) + 1;
  end when;
  for x in 1:3 loop
    connect(terminal[x].n, ground.p);
    connect(terminal[x].p, resistor[x].p);
    connect(resistor[x].n, inductor[x].p);
    connect(inductor[x].n, induced[x].p);
    connect(induced[x].n, star.p);
    connect(potential[x].y, terminal[x].v);
    connect(emf[x].y, induced[x].v);
  end for;
  connect(torque.y, machine.tau);
  connect(machine.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
  connect(bearing.flange_b, housing.flange);
  annotation(experiment(StopTime=0.2, Tolerance=1e-9));
end SixStepMotorOfParts;
