model Mesh "Arrays in every role that FMI gives them"
  parameter Real A[2, 3] = {{-1, 0.5, 0}, {0.25, -2, 0.125}} "Matrix";
  parameter Integer k[2] = {3, 4} "Counted on at each sample";
  parameter Boolean on[2] = {true, false} "Switches";
  input Real u[3](each start = 1, each unit = "1/s") "Rates";
  Real x[3](start = {1, 2, 3}, each fixed = true, each unit = "m") "States";
  output Real y[2](each unit = "m") "A*x";
  Real mixed[3](each unit = "m.s") "A state, an algebraic variable and a constant";
  Real way(start = 0, fixed = true, unit = "m.s") "The state of mixed";
  discrete Real seen[2, 2](each start = 0, each fixed = true, each unit = "m") "Sampled";
  Integer n[2](each start = 0, each fixed = true) "Counted";
  Real two[2](unit = {"1", "rad"}) "Of two units: no array of FMI";
equation
  for i in 1:3 loop
    der(x[i]) = -i*u[i]*x[i];
  end for;
  y = A*x;
  der(way) = x[1];
  mixed[1] = way;
  mixed[2] = 2*way;
  mixed[3] = 7;
  two[1] = sum(x)/x[1];
  two[2] = asin(0.1*two[1]);
  when sample(0.1, 0.25) then
    seen = {{x[1], x[2]}, {x[3], pre(seen[1, 1])}};
    n = {pre(n[1]) + k[1], if on[1] and not on[2] then k[2] else 0};
  end when;
  annotation(experiment(StopTime = 1));
end Mesh;
