// section: 10.6.9
// value: a = 5060, b = 5060, c = 1320, d = 1320, e = 1219
model ElementOfRecordsInFunctions "a subscript behind an array of records is of the element"
  record R
    Real v[2];
    Real a;
  end R;
  record W
    R r[2];
  end W;
  function f
    input Real t;
    output Real s;
  protected
    R r[3];
  algorithm
    for k in 1:3 loop
      r[k] := R({k*t, 10*k}, k);
    end for;
    s := sum(r.v[2]) + 1000*sum(r[2:3].v[1]);
  end f;
  function g
    input Real t;
    output Real s;
  protected
    R r[2, 2];
    W w[2];
  algorithm
    for i in 1:2 loop
      for k in 1:2 loop
        r[i, k] := R({k*t, 10*k + 100*i}, k);
      end for;
    end for;
    w[1] := W({r[1, 1], r[1, 2]});
    w[2] := W({r[2, 1], r[2, 2]});
    s := sum(r[1, :].v[2]) + sum(w.r.v[2]) + sum(w[2].r.v[2]);
  end g;
  function h
    input Real t;
    output Real s;
  protected
    R r[3];
  algorithm
    r.a := {t, 2*t, 3*t};
    r[2:3].a := {7, 8};
    r.v := {{1, 2}, {3, 4}, {5, 6}};
    r.v[1] := {t, t, t};
    s := sum(r.a) + sum(r.v[1]) + 100*sum(r.v[2]);
  end h;
  Real a = f(1), b = f(time), c = g(1), d = g(time), e = h(time);
end ElementOfRecordsInFunctions;
