// section: 5.3.3
// value: a.y = 2
model Global
  encapsulated package P
    constant Real k = 2;
  end P;
  model A
    package P
      constant Real k = 3;
    end P;
    Real y = .Global.P.k;
  end A;
  A a;
end Global;
