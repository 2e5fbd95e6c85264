// section: 12.2
// refuse: R066 9
model TwoAlgorithms
  function f
    input Real a;
    output Real b;
  algorithm
    b := a;
  algorithm
    b := 2*b;
  end f;
  Real x = f(time);
end TwoAlgorithms;
