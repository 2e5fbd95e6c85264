// section: 7.3
// refuse: R034 8
model OtherVariability
  model A
    replaceable parameter Real p = 1;
    Real y = p;
  end A;
  A a(redeclare discrete Real p = 1);
end OtherVariability;
