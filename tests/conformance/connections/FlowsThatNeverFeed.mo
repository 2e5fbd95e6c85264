// section: 15.2
// value: b.brought = 10, d.brought = 7
package Fluid
  connector F
    Real p;
    flow Real m;
    stream Real h;
  end F;
  model Source
    F f;
  equation
    f.m = 0;
    f.h = 10;
  end Source;
  model Sensor
    parameter Boolean reverses = false;
    F f(m(min = if reverses then -1 else 0));
  equation
    f.m = 0;
    f.h = 0;
  end Sensor;
  model Volume
    F f;
    Real brought = inStream(f.h);
  equation
    f.p = 1;
    f.h = 7;
  end Volume;
end Fluid;
model FlowsThatNeverFeed "What a connector holds whose flow is bound to go in is not mixed into what others get"
  Fluid.Source a;
  Fluid.Sensor s[3];
  Fluid.Volume b, d;
equation
  connect(a.f, b.f);
  connect(s[1].f, b.f);
  connect(s[2].f, d.f);
  connect(s[3].f, d.f);
end FlowsThatNeverFeed;
