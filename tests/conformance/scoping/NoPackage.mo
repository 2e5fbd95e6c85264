// section: 5.3.2
// refuse: R075 10
model NoPackage
  model A
    Real x = 2;
    model B
      Real y = 3;
    end B;
  end A;
  A.B b;
end NoPackage;
