// section: 10.6.3
// value: y = 1.4
model ProductOfVaryingSlices
  function f
    input Real a[:];
    input Real b[:];
    input Integer n;
    output Real y;
  algorithm
    y := a[1:n]*b[1:n];
  end f;

    Integer n(start=1, fixed=true);
    Real y = f({time, 0.2, 7}, {1, 2, 3}, n);
  equation
    when time > 0.5 then
      n = 2;
    end when;

end ProductOfVaryingSlices;
