// section: 9.3
// refuse: R077 16
model TwoSources
  connector RealInput = input Real;
  connector RealOutput = output Real;
  block A
    RealOutput y = 1;
  end A;
  block B
    RealInput u;
  end B;
  A a1, a2;
  B b;
equation
  connect(a1.y, b.u);
  connect(a2.y, b.u);
end TwoSources;
