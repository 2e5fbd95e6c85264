// section: 12.4.2
// value: y = 4.5
model FunctionalArgumentWithDefaults "functional argument with extra default inputs (12.4.2)"
  partial function F
    input Real x;
    output Real y;
  end F;
  function g
    extends F;
    input Real k = 3;
  algorithm
    y := k*x;
  end g;
  function int
    input F f;
    input Integer n = 2;
    output Real s = 0;
  algorithm
    for i in 1:n loop
      s := s + f((i - 0.5)/n)/n;
    end for;
  end int;
  Real y = int(g) + int(function g(k=6), n=1);
end FunctionalArgumentWithDefaults;
