// section: 5.3
// refuse: R002 4
model UnknownNameLeftOut "names in an alternative that is not chosen exist"
  Real x = if false then y else 2;
end UnknownNameLeftOut;
