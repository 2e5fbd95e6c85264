// section: 12.9
// refuse: R094 9
model ExternalUnknown
  function secret
    input Real u;
    output Real y;
  external "C" y = my_secret(u);
  end secret;
  Real y = secret(time);
end ExternalUnknown;
