// section: 12.2
// value: q.a = 3, q.b = 9
model RecordResultAtRunTime
  record P
    Real a;
    Real b;
  end P;
  function f
    input Real x;
    output P p;
  algorithm
    p.a := 0;
    p.b := 0;
    while p.a < x loop
      p.a := p.a + 1;
      p.b := p.b + 3;
    end while;
  end f;
  P q = f(2.5*time);
end RecordResultAtRunTime;
