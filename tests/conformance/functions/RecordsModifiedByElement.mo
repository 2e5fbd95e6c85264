// section: 7.2.5
// value: y = 18, z = 9
model RecordsModifiedByElement "the fields of an array of records that a function declares"
  record R
    Real a[2] = {0, 0}, v = 1;
  end R;
  record S
    R r[2];
    Real q = 2;
  end S;
  function f
    input Real x;
    output Real y;
  protected
    S s[2](r(each a={1, x}, v={{1, 2}, {3, 4*x}}), q={5, 6});
  algorithm
    y := s[1].r[2].a[2] + s[2].r[2].v + s[1].q + s[2].q + s[1].r[2].v;
  end f;
  function g "with a loop that stays one"
    input Real x;
    output Real y = 0;
  protected
    R r[3](each a={1, 1}, v={1, 2, x});
    Integer i = 1;
  algorithm
    while i < 2 + x loop
      y := y + r[i].v + r[i].a[2];
      i := i + 1;
    end while;
    y := y + 4;
  end g;
  Real y = f(time), z = g(time);
end RecordsModifiedByElement;
