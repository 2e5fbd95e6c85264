// section: 12.2
// refuse: R054 8
model PreInside
  function f
    input Boolean u;
    output Boolean y;
  algorithm
    y := pre(u);
  end f;
  Boolean x = f(time > 0.5);
end PreInside;
