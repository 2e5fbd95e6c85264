// section: 13.2.1
// refuse: R075 11
model TwoUnqualified
  encapsulated package P
    type T = Real;
  end P;
  encapsulated package Q
    type T = Real;
  end Q;
  import TwoUnqualified.P.*;
  import TwoUnqualified.Q.*;
  T y = 1;
end TwoUnqualified;
