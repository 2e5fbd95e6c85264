// section: 12.4.3
// refuse: R023 12
model MoreResultsThanThereAre
  function f
    input Real a;
    output Real x;
  algorithm
    x := a;
  end f;
  Real c, d;
equation
  (c, d) = f(10);
end MoreResultsThanThereAre;
