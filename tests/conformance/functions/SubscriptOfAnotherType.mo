// section: 10.5
// refuse: R044 10
model SubscriptOfAnotherType
  function f
    input Boolean x;
    output Real e;
  protected
    Real t[2] = {1, 2};
  algorithm
    e := t[x];
  end f;
  Real z = f(true);
end SubscriptOfAnotherType;
