// section: 12.9
// value: y = 0.47942553860420306
model ExternalBuiltin
  function sine
    input Real u;
    output Real y;
  external "builtin" y = sin(u);
  end sine;
  Real y = sine(time/2);
end ExternalBuiltin;
