// section: 7.2
// refuse: R032 7
model UnknownModified
  model A
    Real x = 1;
  end A;
  A a(y=2);
end UnknownModified;
