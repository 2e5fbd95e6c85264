// section: 7.3.2
// refuse: R032 11
model ModifierBeyondTheConstrainingType "a replaceable declaration modifies what its constraining type has"
  model A
    Real y = 1;
  end A;
  model B
    extends A;
    parameter Real q = 2;
  end B;
  model C replaceable A a(q = 3); end C;
  C c(redeclare B a);
end ModifierBeyondTheConstrainingType;
