// section: 4.1
// value: y = 1
model Unused
  expandable connector Bus
  end Bus;
  operator record Number
    Real re;
  end Number;
  function f = der(g, x);
  function g
    input Real x;
    output Real y;
  external "C" y = g(x);
  end g;
  model Clocked
    Real x = previous(x);
  end Clocked;
  Real y = 1;
end Unused;
