// section: 5.3
// refuse: R003 12
model NoFieldInABranch "of a record, in a branch that is not taken"
  record P
    Real x;
  end P;
  function f
    input P p;
    output Real y;
  algorithm
    if p.x > 100 then
      y := p.z;
    else
      y := p.x;
    end if;
  end f;
  Real y = f(P(1));
end NoFieldInABranch;
