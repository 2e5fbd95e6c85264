// section: 9.3
// refuse: R060 15
model TypesDiffer
  connector RealInput = input Real;
  connector IntegerOutput = output Integer;
  block A
    IntegerOutput y = 1;
  end A;
  block B
    RealInput u;
  end B;
  A a;
  B b;
equation
  connect(a.y, b.u);
end TypesDiffer;
