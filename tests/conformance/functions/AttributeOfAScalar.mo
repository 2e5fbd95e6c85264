// section: 12.2
// refuse: R036 6
model AttributeOfAScalar
  function f
    input Real u;
    output Real y(min={1, 2});
  algorithm
    y := u;
  end f;
  Real y = f(time);
end AttributeOfAScalar;
