// section: 12.2
// value: x at 0.5 = 1.6487212707001282, y = 2.718281828459045
model TangentOfManyLocals
  function f
    input Real u;
    input Integer k;
    output Real y;
  protected
    Real a[300];
  algorithm
    a := fill(u, 300);
    y := if k > 3 then a[k] else a[1];
    annotation(Inline=false);
  end f;
  Real x(start=1, fixed=true);
  Real y;
  Integer k = integer(10*time);
equation
  der(x) = f(y, k + 2);
  y = f(x, 2*k + 1);
end TangentOfManyLocals;
