// section: 7.2.5
// value: z[1] = 1
model AttributesOfArraysInAFunction
  function f
    input Real x;
    output Real y[2](start={1, 2}, each min=0);
  protected
    Real w[:](each start=1) = {x, x};
    Real v[n](each start=1);
    parameter Integer n = 2;
    type T = Real[3](min = {0,0,0}, each max=4);
    T t;
    T q[2](each start = {1,2,3});
    Real r[size(w, 1)](start = {1, 1});
  algorithm
    y := {x, x};
    t := {1,1,1};
    v := y;
  end f;
  Real z[2] = f(time);
end AttributesOfArraysInAFunction;
