// section: 12.3
// refuse: R082 10
model ExtendsAnImpureFunction "a function that extends an impure one is impure"
  impure function f
    input Real x;
    output Real y;
  algorithm
    y := x;
  end f;
  function g
    extends f;
  end g;
  Real z(start=0, fixed=true);
equation
  when time > 0.5 then
    z = g(time);
  end when;
end ExtendsAnImpureFunction;
