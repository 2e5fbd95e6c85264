// section: 12.3
// refuse: R082 10
model ImpureInAnEquation
  impure function f
    input Real u;
    output Real y;
  algorithm
    y := u;
  end f;
  Real x = f(time);
end ImpureInAnEquation;
