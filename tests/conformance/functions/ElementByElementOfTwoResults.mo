// section: 12.4.6
// refuse: R062 13
model ElementByElementOfTwoResults
  function f
    input Real a;
    output Real b, c;
  algorithm
    b := a;
    c := 2*a;
  end f;
  Real y[2], z[2];
equation
  (y, z) = f({1, 2});
end ElementByElementOfTwoResults;
