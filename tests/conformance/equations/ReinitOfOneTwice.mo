// section: 8.3.6
// refuse: S011 10
model ReinitOfOneTwice
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  when time > 0.5 then
    reinit(x, 0);
  end when;
  when time > 0.7 then reinit(x, 1);
  end when;
end ReinitOfOneTwice;
