// section: 12.1.2
// value: y at 0.5 = 2.5
package Gains
  constant Real c = 5;
  function h
    input Real x;
    input Real a = 1;
    output Real y = a*x;
  algorithm
  end h;
  function k = h(a = c);
  model M
    Real y = k(time);
  end M;
end Gains;
model ShortFunctionOfAPackageConstant "a default is looked up where the short definition stands"
  extends Gains.M;
end ShortFunctionOfAPackageConstant;
