// section: 12.7.1
// value: y = 40, dy = 1040, z = 20, dz = 2040
model DerivativeWhereAnInputIsStill "zeroDerivative: the first annotation that holds"
  function f
    input Real k;
    input Real x;
    output Real y;
  algorithm
    y := 0;
    for i in 1:20 loop
      if y < 1e6 then
        y := y + k*x;
      end if;
    end for;
    annotation(derivative(zeroDerivative=k)=dfx, derivative=df);
  end f;
  function dfx
    input Real k;
    input Real x;
    input Real dx;
    output Real dy;
  algorithm
    dy := 1000 + 20*k*dx;
  end dfx;
  function df
    input Real k;
    input Real x;
    input Real dk;
    input Real dx;
    output Real dy;
  algorithm
    dy := 2000 + 20*(k*dx + dk*x);
  end df;
  parameter Real p = 2;
  Real y = f(p, time);
  Real z = f(time, time);
  Real dy = der(y);
  Real dz = der(z);
end DerivativeWhereAnInputIsStill;
