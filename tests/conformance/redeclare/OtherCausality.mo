// section: 7.3
// refuse: R034 8
model OtherCausality
  block A
    replaceable input Real u;
    Real y = u;
  end A;
  A a(redeclare output Real u = 1);
end OtherCausality;
