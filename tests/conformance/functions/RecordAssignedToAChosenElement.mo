// section: 12.6
// value: y[1] at 0.25 = 0.25, y[2] at 0.25 = 1, y[1] = 2, y[2] = 4, y[3] = 3, y[4] = 5, y[5] = -1, y[6] = 7
model RecordAssignedToAChosenElement "an element of an array of records, by a subscript that varies, gets all fields"
  record R
    Real a;
    Real b;
  end R;
  record S
    Real v[2];
  end S;
  function two
    input Real x;
    output R a = R(x, 2*x);
    output R b = R(3*x, 4*x);
  algorithm
  end two;
  function f
    input Integer i;
    input Integer k;
    input Real x;
    output Real y[6];
  protected
    R p[2] = fill(R(1, 1), 2), q[3] = fill(R(1, 1), 3);
    S s[2] = fill(S({1, 2}), 2);
  algorithm
    (p[i], q[i]) := two(x);
    s[i].v[k] := 5;
    y[1:4] := {p[1].a, q[2].b, q[2].a, s[2].v[1]};
    q[k] := R(q[k].b + 1, q[k].a + q[i].a) "read before any field is set";
    y[1] := if i == 1 then p[1].a else q[1].a;
    p[if p[1].a > -5 then 1 else 2] := R(-x, 7) "chosen before any field is set";
    y[5:6] := {p[1].a, p[1].b};
  end f;
  Integer i = if time > 0.5 then 2 else 1;
  Real y[6] = f(i, 3 - i, time);
end RecordAssignedToAChosenElement;
