// section: 12.4.4
// value: x = 1
model ResultNotWanted
  function f
    input Real a;
    output Real b;
  algorithm
    b := 2*a;
  end f;
  Real x = time;
equation
  f(x);
end ResultNotWanted;
