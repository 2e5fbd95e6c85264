// section: 12.4.2.1
// value: y = 7
model InputBound
  partial function pf
    input Real x; output Real y;
  end pf;
  function lin
    input Real x; input Real a; output Real y;
  algorithm
    y := a*x + 1;
  end lin;
  function ap
    input pf g; output Real y;
  algorithm
    y := g(2);
  end ap;
  Real y = ap(function lin(a=3));
end InputBound;
