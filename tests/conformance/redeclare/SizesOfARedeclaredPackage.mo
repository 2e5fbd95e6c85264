// section: 7.3
// value: h.c.x[4] = 8, s = 8
model SizesOfARedeclaredPackage "constants of a redeclared package as array sizes in a conditional component"
  package P1
    constant Integer n = 2;
    constant Real k = 1;
  end P1;
  package P2
    extends P1(n = 4, k = 2);
  end P2;
  model C
    replaceable package P = P1;
    Real x[P.n] = {P.k*i*time for i in 1:P.n};
  end C;
  model H
    parameter Boolean on = false;
    replaceable package Q = P1;
    C c(redeclare package P = Q) if on;
  end H;
  H h(on = true, redeclare package Q = P2);
  H g(redeclare package Q = P2);
  Real s = size({1,2,3,4,5,6,7,8}, 1)*time;
end SizesOfARedeclaredPackage;
