// section: 12.4.4
// refuse: R024 11
model RealResultOfAnInteger "the result of a function is a Real, whatever it is given"
  function f
    input Real x;
    output Real y;
  algorithm
    y := x;
  end f;
  Integer n = integer(3*time);
  Integer k = f(n);
end RealResultOfAnInteger;
