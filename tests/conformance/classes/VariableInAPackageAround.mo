// section: 4.7
// refuse: R070 5
model VariableInAPackageAround
  package P
    Real z = 1;
    model M
      Real y = time;
    end M;
  end P;
  P.M m;
end VariableInAPackageAround;
