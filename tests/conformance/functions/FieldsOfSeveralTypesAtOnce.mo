// section: 12.4.4
// value: x = 12, n = 5
model FieldsOfSeveralTypesAtOnce "Each keeps its type where the assignment reads what it sets"
  record R
    Boolean odd;
    Real a;
    Integer n;
  end R;
  function f
    input Real u;
    output R r;
  algorithm
    r := R(true, u, 1);
    while r.a < 10 loop
      r := R(not r.odd, r.a*2, if r.odd then r.n + 1 else r.n + 2);
    end while;
  end f;
  parameter Real u = 1.5;
  parameter R r = f(u);
  Real x = r.a;
  Real n = r.n;
end FieldsOfSeveralTypesAtOnce;
