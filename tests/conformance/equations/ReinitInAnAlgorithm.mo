// section: 8.3.6
// refuse: R056 7
model ReinitInAnAlgorithm
  Real x(start=0, fixed=true);
algorithm
  when time > 0.5 then
    reinit(x, 2);
  end when;
equation
  der(x) = 1;
end ReinitInAnAlgorithm;
