// section: 12.2
// refuse: R058 8
model InputAssigned
  function f
    input Real a;
    output Real b;
  algorithm
    a := 1;
    b := a;
  end f;
  Real x = f(time);
end InputAssigned;
