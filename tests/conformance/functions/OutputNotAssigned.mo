// section: 12.4.4
// refuse: F033 6
model OutputNotAssigned
  function f
    input Real a;
    output Real b;
  algorithm
  end f;
  Real x = f(time);
end OutputNotAssigned;
