// section: 7.1.2
// value: y = 50
package Units
  type Frequency = Real(unit = "Hz");
end Units;
package Data
  import U = Units;
  record A
    parameter U.Frequency f = 50;
  end A;
end Data;
model SameByAnotherName
  record B
    extends Data.A;
    parameter Units.Frequency f = 50;
  end B;
  B b;
  Real y = b.f/f1;
  parameter Real f1(unit = "Hz") = 1;
end SameByAnotherName;
