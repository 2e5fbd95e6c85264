// section: 12.4.1
// value: y = 7, z = 7
model NamedInAnyOrder
  function f
    input Real a;
    input Real b;
    output Real c;
  algorithm
    c := 2*a + b;
  end f;
  Real y = f(b=1, a=3), z = f(3, b=1);
end NamedInAnyOrder;
