// section: 9.2
// refuse: R060 14
model ArrayOfOneAndAScalar "connected arrays have the same dimensions"
  block S
    output Real y[1];
  equation
    y = {time};
  end S;
  connector In = input Real;
  S a;
  In u;
  Real v = u;
equation
  connect(a.y, u);
end ArrayOfOneAndAScalar;
