// section: 10.5
// value: G[1,1] at 0 = 1, G[1,2] at 0 = -1, G[2,2] at 0 = 11, G[2,3] at 0 = -10, G[3,1] at 0 = 0, G[3,3] at 0 = 10
// value: G[1,1] = 0, G[2,2] = 12, G[2,3] = -12, G[3,2] = -12, G[3,3] = 12, y[1] at 0 = 2, y[2] at 0 = 1
// value: y[2] = 3, y[3] = 2, r[2].b = 30, r[3].b = 20, r[3].a = 2, n[1] = 8, n[2] = 7, n[3] = 3, u[1] = 2, u[2] = 1
model VectorOfVaryingSubscripts "Read and set by vectors of subscripts, of which sizes alone are known"
  record R
    Real a;
    Real b;
  end R;
  function stamped "Conductances between the nodes of branches"
    input Integer ends[:, 2];
    input Real g[size(ends, 1)];
    output Real G[3, 3] = zeros(3, 3);
  algorithm
    for l in 1:size(ends, 1) loop
      G[ends[l, :], ends[l, :]] := G[ends[l, :], ends[l, :]] + g[l]*[1, -1; -1, 1];
    end for;
  end stamped;
  function exchanged
    input Integer k[2];
    output Real y[3] = {1, 2, 3};
    output R r[3] = {R(1, 10), R(2, 20), R(3, 30)};
    output Integer n[3] = {2, 1, 3};
  algorithm
    y[k] := y[{k[2], k[1]}];
    r[k] := r[{k[2], k[1]}];
    n[n[1:2]] := {7, 8};
  end exchanged;
  function found
    input Real v[3];
    output Real u[2];
  protected
    Integer k = 1 "not the one of the model";
  algorithm
    while v[k] < 2 loop
      k := k + 1;
    end while;
    u := v[{k, 1}];
  end found;
  constant Integer k = 1;
  Integer a = if time > 0.5 then 3 else 1;
  Real G[3, 3] = stamped({{a, 2}, {2, 3}}, {1 + time, 10});
  Real y[3];
  R r[3];
  Integer n[3];
  Real u[2] = found({time, 2*time, 3});
equation
  (y, r, n) = exchanged({a, 2});
end VectorOfVaryingSubscripts;
