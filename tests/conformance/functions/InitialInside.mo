// section: 12.2
// refuse: R054 8
model InitialInside
  function f
    input Real u;
    output Real y;
  algorithm
    y := if initial() then 0 else u;
  end f;
  Real x = f(2);
end InitialInside;
