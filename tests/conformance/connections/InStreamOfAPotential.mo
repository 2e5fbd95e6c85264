// section: 15.2
// refuse: R052 10
model InStreamOfAPotential
  connector P
    Real p;
    flow Real m;
    stream Real h;
  end P;
  P port;
  Real h = inStream(port.p);
equation
  port.p = 1;
  port.h = 2;
end InStreamOfAPotential;
