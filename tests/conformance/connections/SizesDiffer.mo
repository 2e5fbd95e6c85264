// section: 9.3
// refuse: R060 15
model SizesDiffer
  connector I = input Real;
  connector O = output Real;
  block A
    O y[2] = {1, 2};
  end A;
  block B
    I u[3];
    Real s = sum(u);
  end B;
  A a; B b;
equation
  connect(a.y, b.u);
end SizesDiffer;
