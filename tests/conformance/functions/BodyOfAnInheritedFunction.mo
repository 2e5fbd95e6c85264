// section: 5.6.1.1
// value: x = 3, y = 3, z = 3, n = 8
package Near "The names in a body mean what they mean where it is written"
  constant Real k = 3;
  constant Real twice = 2;
  function f
    input Real u;
    output Real y;
  algorithm
    y := scaled(u);
  end f;
  function scaled
    input Real u;
    output Real y = k*u;
  algorithm
  end scaled;
  function count "runs at run time"
    input Real u;
    output Real n = 0;
  protected
    Real a = 1;
  algorithm
    while a < u loop
      a := a*twice;
      n := n + twice;
    end while;
  end count;
end Near;
package Far
  constant Real k = 100;
  constant Real twice = 10;
  function short = Near.f;
  function long
    extends Near.f;
  end long;
  function count
    extends Near.count;
  end count;
end Far;
model BodyOfAnInheritedFunction
  function h = Near.f;
  Real x = Far.short(time), y = Far.long(time), z = h(time);
  Real n = Far.count(12 + time);
end BodyOfAnInheritedFunction;
