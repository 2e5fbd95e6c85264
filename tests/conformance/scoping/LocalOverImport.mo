// section: 5.3.1
// value: a.y = 3
model LocalOverImport
  encapsulated package P
    constant Real x = 2;
  end P;
  model A
    import LocalOverImport.P.*;
    Real x = 3;
    Real y = x;
  end A;
  A a;
end LocalOverImport;
