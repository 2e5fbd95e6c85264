// section: 4.4
// refuse: R010 7
model ComponentAndClass
  model A
    Real x = 1;
  end A;
  A A;
end ComponentAndClass;
