// section: 7.3.2
// refuse: R034 11
model OwnTypeNoSubtype
  model A
    Real x = 1;
  end A;
  model B
    Real x = 2;
    Real y = 3;
  end B;
  replaceable A a constrainedby B;
end OwnTypeNoSubtype;
