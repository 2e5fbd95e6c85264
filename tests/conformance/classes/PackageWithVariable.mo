// section: 4.7
// refuse: R070 5
model PackageWithVariable
  package P
    Real x = 1;
    constant Real k = 2;
  end P;
  Real y = P.k;
end PackageWithVariable;
