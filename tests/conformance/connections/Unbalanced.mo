// section: 9.3.1
// refuse: R077 4
model Unbalanced
  connector C
    Real a;
    Real b;
    flow Real f;
  end C;
  model M
    C c(a=1, b=2);
  end M;
  M m;
end Unbalanced;
