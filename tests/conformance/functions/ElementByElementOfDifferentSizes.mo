// section: 12.4.6
// refuse: R062 11
model ElementByElementOfDifferentSizes
  function f
    input Real a;
    input Real b;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y[2] = f({1, 2}, {1, 2, 3});
end ElementByElementOfDifferentSizes;
