// section: 5.3.1
// value: m.a = 3, m.b = -1, m.c = 2
package Own
  function abs "Of a pair"
    input Real u[2];
    output Real y;
  algorithm
    y := u[1] + u[2];
  end abs;
  function cos
    input Real u;
    output Real y;
  algorithm
    y := .cos(u) - 2;
  end cos;
  model M
    import Own.abs;
    Real a = abs({1, 2});
    Real b = Own.cos(0);
    Real c = .abs(-2);
  end M;
end Own;
model ImportHidesBuiltin
  Own.M m;
end ImportHidesBuiltin;
