// code: R091
// line: 7
// hint: variable of the connector
connector Port
  Real p;
  flow Real m;
  stream Real h;
end Port;
model M
  Port port;
end M;
