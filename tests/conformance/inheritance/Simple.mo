// section: 7.1
// value: y = 6
model Simple
  partial model A
    parameter Real k = 2;
    Real x = 3;
  end A;
  extends A;
  Real y = k*x;
end Simple;
