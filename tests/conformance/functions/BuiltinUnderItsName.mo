// section: 12.9
// value: x = 0.7853981633974483
package Math
  function atan2
    input Real u1;
    input Real u2;
    output Real y;
    external "builtin" y = atan2(u1, u2);
  end atan2;
end Math;
model BuiltinUnderItsName
  Real x = Math.atan2(time, time);
end BuiltinUnderItsName;
