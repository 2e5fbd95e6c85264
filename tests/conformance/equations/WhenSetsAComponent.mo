// section: 4.4.4
// refuse: R058 11
model WhenSetsAComponent "A variable of a block is set by the block"
  block B
    discrete input Real x(start = 0, fixed = true);
    Real y = 2*x;
  end B;
  B b;
equation
  when time > 0.5 then
    b.x = 1;
  end when;
end WhenSetsAComponent;
