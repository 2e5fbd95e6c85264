// section: 15.2
// value: h = 5.5
model InStreamThreeWay "two sources mix by their flows"
  connector P
    Real p;
    flow Real m;
    stream Real h;
  end P;
  model Src
    P c;
    parameter Real m, h;
  equation
    c.m = -m;
    c.h = h;
  end Src;
  model Snk
    P c;
    Real h = inStream(c.h);
  equation
    c.p = 1;
    c.h = 0;
  end Snk;
  Src a(m=3, h=5), b(m=1, h=7);
  Snk k;
  Real h = k.h;
equation
  connect(a.c, k.c);
  connect(b.c, k.c);
end InStreamThreeWay;
