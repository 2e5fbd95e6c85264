// section: 5.3.2
// refuse: R075 7
model PartialPackage
  partial package P
    constant Real x = 4;
  end P;
  Real y = P.x;
end PartialPackage;
