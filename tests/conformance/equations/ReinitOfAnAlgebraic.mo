// section: 8.3.6
// refuse: R056 10
model ReinitOfAnAlgebraic "reinit outside of when"
  Real x(start=0, fixed=true);
  Real y;
equation
  der(x) = 1;
  y = 2*x;

  reinit(x, 0);
end ReinitOfAnAlgebraic;
