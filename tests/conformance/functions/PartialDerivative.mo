// section: 12.7.2
// value: y = 3
model PartialDerivative
  function g
    input Real p;
    input Real T;
    output Real g = p*T^2;
  algorithm
  end g;
  function gT = der(g, T);
  Real y = gT(0.5, 3);
end PartialDerivative;
