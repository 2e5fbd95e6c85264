// section: 12.4.2
// value: planet1.f[3] = -6, planet2.g[2] = -6
partial function GI
  input Real position[3];
  output Real acceleration[3];
end GI;
function PMG
  extends GI;
  input Real m;
algorithm
  acceleration := -m*position;
end PMG;
model Body
  replaceable function gravity = GI;
  Real r[3] = {1, 2, 3};
  Real f[3] = gravity(r);
  Real g[3] = gravity(position = r);
end Body;
model FunctionWithParametersOfTheModel
  parameter Real mSun = 2;
  function sunGravity = PMG(m = mSun);
  Body planet1(redeclare function gravity = sunGravity);
  Body planet2(redeclare function gravity = PMG(m = 3));
end FunctionWithParametersOfTheModel;
