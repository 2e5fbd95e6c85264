// section: 12.2
// value: r = 6, s = 18
model RecordAtRunTime
  record P
    Real a;
    Real b[2];
  end P;
  function f
    input P p;
    input Real x;
    output Real y;
  protected
    Integer i;
  algorithm
    y := 0;
    i := 1;
    while y < x loop
      y := y + p.a + p.b[i];
      i := if i == 1 then 2 else 1;
    end while;
  end f;
  Real r = f(P(1, {1, 3}), 3 + 2*time);
  Real s = f(P(time, {4, 3*time}), 17);
end RecordAtRunTime;
