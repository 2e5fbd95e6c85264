model ChemicalKinetics "Robertson's stiff reaction with its conservation law as an algebraic equation"
  Real y1(start=1, fixed=true), y2(start=0, fixed=true), y3;
equation
  der(y1) = -0.04*y1 + 1e4*y2*y3;
  der(y2) = 0.04*y1 - 1e4*y2*y3 - 3e7*y2^2;
  y1 + y2 + y3 = 1;
  annotation(experiment(StopTime=40, Interval=0.1));
end ChemicalKinetics;
