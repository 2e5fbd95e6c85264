// section: 9.3
// refuse: R060 16
model ParametersDiffer
  connector C
    parameter Integer n = 1;
    Real e;
    flow Real f;
  end C;
  model M
    C c;
  equation
    c.e = 1;
  end M;
  M a(c(n=1)), b(c(n=2));
equation
  connect(a.c, b.c);
end ParametersDiffer;
