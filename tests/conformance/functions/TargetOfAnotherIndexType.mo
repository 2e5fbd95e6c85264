// section: 10.5
// refuse: R044 11
model TargetOfAnotherIndexType
  type E = enumeration(a, b);
  function f
    input Real x;
    output Real e;
  protected
    Real t[2] = {1, 2};
  algorithm
    t[E.b] := x;
    e := t[1];
  end f;
  Real z = f(time);
end TargetOfAnotherIndexType;
