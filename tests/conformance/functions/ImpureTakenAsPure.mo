// section: 12.3
// value: y = 2, a = 4, b = 5
model ImpureTakenAsPure
  impure function f
    input Real x;
    output Real y;
  algorithm
    y := 2*x;
  end f;
  impure function two
    input Real x;
    output Real u;
    output Real v;
  algorithm
    u := f(x);
    v := f(x) + 1;
  end two;
  Real y = pure(f(time));
  Real a, b;
equation
  (a, b) = pure(two(2));
end ImpureTakenAsPure;
