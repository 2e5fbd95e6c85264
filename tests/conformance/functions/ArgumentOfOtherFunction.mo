// section: 12.4.2
// refuse: R062 15
model ArgumentOfOtherFunction
  partial function pf
    input Real x; output Real y;
  end pf;
  function lin
    input Real x[2]; output Boolean y;
  algorithm
    y := true;
  end lin;
  function ap
    input pf g; output Real y;
  algorithm
    y := g(2);
  end ap;
  Real y = ap(lin);
end ArgumentOfOtherFunction;
