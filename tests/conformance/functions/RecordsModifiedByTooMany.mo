// section: 7.2.5
// refuse: R036 11
model RecordsModifiedByTooMany
  record R
    Real v = 1;
  end R;
  function f
    input Real x;
    output Real y;
  protected
    R r[2](v={1, 2, 3});
  algorithm
    y := x*r[1].v;
  end f;
  Real y = f(time);
end RecordsModifiedByTooMany;
