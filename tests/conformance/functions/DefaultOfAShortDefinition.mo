// section: 12.4.1, 7.3
// value: a = 5, b = 3, c = 12, d = 7
model DefaultOfAShortDefinition "What a short definition gives is a default: an argument by position or name replaces it"
  function f
    input Real x;
    output Real y;
  algorithm
    y := x;
  end f;
  function three = f(x = 3.0);
  function g
    replaceable input Real u;
    input Real v = 2;
    replaceable output Real y;
  algorithm
    y := u + v;
  end g;
  function h = g(redeclare Real u = 5.0, redeclare Real y = 4.0) "an input and an output still";
  Real a = three(5.0);
  Real b = three();
  Real c = h(10);
  Real d = h();
end DefaultOfAShortDefinition;
