model SpringChain "Five equal masses between six equal springs: arrays and a for loop"
  parameter Integer n = 5 "Number of masses";
  parameter Real m(unit="kg") = 0.1 "Each mass";
  parameter Real c(unit="N/m") = 20 "Each spring";
  parameter Real d(unit="N.s/m") = 0.05 "Damping of each mass";
  Real x[n](each unit="m", start={0.1, 0, 0, 0, -0.05}, each fixed=true) "Displacements";
  Real v[n](each unit="m/s", each start=0, each fixed=true) "Speeds";
equation
  for k in 1:n loop
    der(x[k]) = v[k];
    m*der(v[k]) = c*((if k > 1 then x[max(k - 1, 1)] else 0) - 2*x[k] + (if k < n then x[min(k + 1, n)] else 0)) - d*v[k];
  end for;
  annotation(experiment(StopTime=4, Interval=0.01));
end SpringChain;
