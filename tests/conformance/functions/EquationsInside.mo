// section: 12.2
// refuse: R066 7
model EquationsInside
  function f
    input Real a;
    output Real b;
  equation
    b = a;
  end f;
  Real x = f(time);
end EquationsInside;
