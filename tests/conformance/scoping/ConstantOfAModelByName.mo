// section: 5.3.2
// refuse: R075 8
model ConstantOfAModelByName
  model A
    constant Real x = 2;
    Real y = 3;
  end A;
  Real z = A.x*time;
end ConstantOfAModelByName;
