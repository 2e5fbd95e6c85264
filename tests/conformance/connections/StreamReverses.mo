// section: 15.2
// value: v.hin at 0.25 = 5, v.hin at 0.75 = 7, v.act at 0.25 = 5, v.act at 0.75 = 3
model StreamReverses "reversing flow"
  connector P
    Real p;
    flow Real m;
    stream Real h;
  end P;
  model Source
    P port;
    Real h0 = 1;
  equation
    port.m = -cos(3.141592653589793*time);
    port.h = h0;
  end Source;
  model Tank
    P port;
    Real hin = inStream(port.h);
    Real act = actualStream(port.h);
  equation
    port.p = 1;
    port.h = 3;
  end Tank;
  model Var
    P port;
  equation
    port.m = 0;
    port.h = 100;
  end Var;
  Source s(h0 = if time < 0.5 then 5 else 7);
  Tank v;
equation
  connect(s.port, v.port);
end StreamReverses;
