// section: 12.4.4
// value: x = 4, y = 2, z = 2
model SumToAParameter "How far a sum, a slice or an array inside a function goes may follow a parameter"
  function f
    input Real a[:];
    input Integer n;
    output Real s;
  algorithm
    s := sum(a[i]*2 for i in 1:n);
  end f;
  function g
    input Real a[:];
    input Integer n;
    output Real s;
  algorithm
    s := sum(a[1:n]);
  end g;
  function h
    input Real a[:];
    input Integer n;
    output Real s;
  protected
    Real w[n];
  algorithm
    for i in 1:n loop
      w[i] := a[i];
    end for;
    s := sum(w);
  end h;
  parameter Integer n = 2;
  Real v[3] = {1, time, 3};
  Real x = f(v, n), y = g(v, n), z = h(v, n);
end SumToAParameter;
