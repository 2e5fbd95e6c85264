// section: 5.3.1
// refuse: R075 11
package P
  constant Real p = 2;
end P;
package Q
  constant Real p = 3;
end Q;
model TwoUnqualifiedConstants
  import P.*;
  import Q.*;
  Real y = p;
end TwoUnqualifiedConstants;
