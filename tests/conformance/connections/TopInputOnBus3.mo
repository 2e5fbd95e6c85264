// section: 9.1.3
// value: y = 0
model TopInputOnBus3
  connector RealInput = input Real;
  expandable connector EC
  end EC;
  EC ec;
  RealInput ri[3];
  Real y = 0*sum(ri);
equation
  connect(ri, ec.x);
end TopInputOnBus3;
