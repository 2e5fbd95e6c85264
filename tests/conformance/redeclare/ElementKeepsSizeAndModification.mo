// section: 7.3.2
// value: y[1] = 6, y[2] = 8, c.k = 5
model ElementKeepsSizeAndModification "written as an element: names of the base are looked up there"
  package P
    constant Integer n = 2;
    constant Boolean wanted = true;
    constant Real third = 3;
    block Gain
      parameter Real k = 1;
      Real y = k;
    end Gain;
    model Base
      replaceable Gain g[n](k={third, 4});
      replaceable Gain c(k=5) if wanted;
      Real y[n] = g.y;
    end Base;
  end P;
  block Twice
    parameter Real k = 1;
    Real y = 2*k;
  end Twice;
  extends P.Base;
  redeclare Twice g;
  redeclare Twice c;
end ElementKeepsSizeAndModification;
