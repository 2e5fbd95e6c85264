// section: 6.5, 12.3
// refuse: R034 19
model ImpureForPure "an impure function does not stand for a pure one"
  function f1
    input Real x;
    output Real y;
  algorithm
    y := x;
  end f1;
  impure function f2
    input Real x;
    output Real y;
  algorithm
    y := 2*x;
  end f2;
  model A
    replaceable function f = f1;
  end A;
  A a(redeclare function f = f2);
end ImpureForPure;
