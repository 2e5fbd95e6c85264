// section: 5.3.1
// value: a.y = 4
model QualifiedFirst
  encapsulated package P
    constant Real x = 2;
  end P;
  encapsulated package Q
    constant Real x = 4;
  end Q;
  model A
    import QualifiedFirst.P.*;
    import QualifiedFirst.Q.x;
    Real y = x;
  end A;
  A a;
end QualifiedFirst;
