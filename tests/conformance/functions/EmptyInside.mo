// section: 10.7
// value: y = 1
model EmptyInside
  function f
    input Real v[:];
    input Real u;
    output Real y;
  protected
    Real w[size(v, 1)];
    Real rest;
  algorithm
    w := v;
    rest := u;
    while rest > 1 loop
      rest := rest - 1;
    end while;
    y := rest + sum(w);
  end f;
  Real y = f(zeros(0), 3*time);
end EmptyInside;
