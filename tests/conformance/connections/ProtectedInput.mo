// section: 9.3
// value: s.y = 2
model ProtectedInput
  connector RealInput = input Real;
  connector RealOutput = output Real;
  block Constant
    RealOutput y = 2;
  end Constant;
  block Source
    RealInput f;
    RealOutput y;
  protected
    RealInput internal;
  equation
    connect(f, internal);
    y = internal;
  end Source;
  Constant c;
  Source s;
equation
  connect(c.y, s.f);
end ProtectedInput;
