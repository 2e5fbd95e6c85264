// section: 7.1.2
// refuse: R010 11
model SameNameAnotherType
  type Frequency = Real(unit = "Hz");
  type Speed = Real(unit = "rad/s");
  record A
    parameter Frequency f = 50;
  end A;
  record B
    extends A;
    parameter Speed f = 50;
  end B;
  B b;
end SameNameAnotherType;
