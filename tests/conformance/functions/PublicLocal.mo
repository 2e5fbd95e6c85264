// section: 12.2
// refuse: R066 7
model PublicLocal
  function f
    input Real a;
    output Real b;
    Real c;
  algorithm
    c := a;
    b := c;
  end f;
  Real x = f(time);
end PublicLocal;
