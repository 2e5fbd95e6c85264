// section: 13.2.1
// refuse: R017 8
model ProtectedImport
  encapsulated package P
  protected
    constant Real b = 2;
  end P;
  import ProtectedImport.P.b;
  Real y = b;
end ProtectedImport;
