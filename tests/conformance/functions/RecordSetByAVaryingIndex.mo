// section: 12.6
// value: y[2].b = 6, x = 2, y[1].a = 1, z[2,1].n = 3, z[1,1].n = 1, z[2,1].b = 4.5
model RecordSetByAVaryingIndex
  record R
    Real a;
    Real b;
  end R;
  record S
    Integer n;
    Real b;
  end S;
  function squares
    input Integer k;
    input Real u;
    output R y[2];
  algorithm
    y := fill(R(1, 1), 2);
    y[k] := R(u^2, 3*u);
  end squares;
  function counted
    input Integer at[:];
    output S z[2, 1] = fill(S(1, 2), 2, 1);
  algorithm
    for k in at loop
      z[k, 1] := S(z[k, 1].n + 1, z[k, 1].b);
      z[k, 1].b := z[k, 1].b + z[k, 1].n/2;
    end for;
  end counted;
  parameter Integer k = 2;
  Real x(start = 1);
  R y[2] = squares(k, x);
  S z[2, 1] = counted(if time > 0.5 then {k, k} else {1, k});
equation
  x + y[k].a + y[1].b = 6 + time;
end RecordSetByAVaryingIndex;
