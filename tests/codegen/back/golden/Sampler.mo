model Sampler "a sampled controller of a first-order plant, which counts its saturations"
  parameter Real Ts(unit = "s") = 0.1;
  parameter Real rate(unit = "1/s") = 2;
  parameter Real gain = 3;
  discrete Real u(start = 0, fixed = true);
  Real x(start = 0, fixed = true);
  Integer n(start = 0, fixed = true);
  Boolean high;
equation
  der(x) = rate*(u - x);
  high = x > 0.7;
  when sample(0, Ts) then
    u = gain*(1 - x);
  end when;
algorithm
  when high then
    n := n + 1;
    assert(n < 100, "too many saturations");
  elsewhen x < 0.2 and n > 10 then
    n := 0;
  end when;
end Sampler;
