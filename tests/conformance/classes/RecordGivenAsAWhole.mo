// section: 7.2.4
// value: c.s = 30, d.s = 12, e.s = 3
package Data
  record Curve
    parameter Real v[:] = {1};
    parameter Real w[size(v, 1)] = 2*v;
  end Curve;
  record Pump
    parameter Curve curve(v = {0, 0});
    parameter Real q = 3;
  end Pump;
  model Plant
    parameter Pump pump;
    Real s = sum(pump.curve.v) + sum(pump.curve.w) + pump.q;
  end Plant;
end Data;
model RecordGivenAsAWhole "A value from outside stands before what is said of its parts further inside"
  parameter Data.Pump big(curve = Data.Curve(v = {1, 2, 3}, w = {4, 5, 6}), q = 9);
  Data.Plant c(pump = big);
  Data.Plant d(pump = Data.Pump(curve = Data.Curve({5}, {6}), q = 1));
  Data.Plant e;
end RecordGivenAsAWhole;
