// section: 12.4.6
// value: y[1] = 2, y[3] = 6, z[2] = 7
model ElementByElement
  function f
    input Real a;
    input Real b = 0;
    output Real c;
  algorithm
    c := 2*a + b;
  end f;
  Real y[3] = f({1, 2, 3});
  Real z[2] = f({1, 2}, {4, 3});
end ElementByElement;
