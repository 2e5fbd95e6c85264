// section: 7.3
// value: a = 2, b = 3, c = 1
model TwoModifiedPackages
  package P
    constant Real k = 1;
    function f
      output Real y;
    algorithm
      y := k;
    end f;
  end P;
  package Q = P(k=2);
  package R = P(k=3);
  Real a = Q.f(), b = R.f(), c = P.f();
end TwoModifiedPackages;
