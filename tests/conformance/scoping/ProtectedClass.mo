// section: 4.1
// refuse: R017 8
model ProtectedClass
  package P
  protected
    type T = Real;
  end P;
  P.T y = 1;
end ProtectedClass;
