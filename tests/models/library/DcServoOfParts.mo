model DcServoOfParts "T1 from parts of the Modelica Standard Library, beside ours"
  Modelica.Blocks.Sources.Sine voltage(amplitude=10, f=0.5);
  Modelica.Electrical.Analog.Sources.SignalVoltage drive;
  Modelica.Electrical.Analog.Basic.Ground ground;
  Modelica.Electrical.Analog.Basic.Resistor resistor(R=3.5);
  Modelica.Electrical.Analog.Basic.Inductor inductor(L=3.3e-3, i(start=0, fixed=true));
  Modelica.Electrical.Analog.Basic.RotationalEMF emf(k=0.03);
  Modelica.Mechanics.Rotational.Components.Inertia shaft(J=7e-6, phi(start=0, fixed=true), w(start=0, fixed=true));
  Modelica.Mechanics.Rotational.Components.Damper bearing(d=2e-5);
  Modelica.Mechanics.Rotational.Components.Fixed housing;
  Lacuna.Benches.DcServo ours;
equation
  connect(voltage.y, drive.v);
  connect(drive.p, resistor.p);
  connect(resistor.n, inductor.p);
  connect(inductor.n, emf.p);
  connect(emf.n, drive.n);
  connect(drive.n, ground.p);
  connect(emf.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
  connect(bearing.flange_b, housing.flange);
  ours.u = voltage.y;
  annotation(experiment(StopTime=2, Tolerance=1e-9));
end DcServoOfParts;
