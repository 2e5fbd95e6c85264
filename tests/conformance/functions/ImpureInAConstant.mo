// section: 12.3
// refuse: R082 9
model ImpureInAConstant "a parameter may be bound to one"
  impure function f
    output Real y = 1;
  algorithm
  end f;
  parameter Real p = f();
  constant Real c = f();
  Real x = p*c;
end ImpureInAConstant;
