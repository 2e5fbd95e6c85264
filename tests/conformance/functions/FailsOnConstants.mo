// section: 12.4
// refuse: F035 11
model FailsOnConstants
  function root
    input Real u;
    output Real y;
  algorithm
    assert(u >= 0, "negative");
    y := sqrt(u);
  end root;
  Real y = root(-1);
end FailsOnConstants;
