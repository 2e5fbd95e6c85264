// section: 8.5
// value: x = 1, n = 1, y = 3
model EventsOfAWholeMadeReal "a pulse of a thousandth of a step"
  function f
    input Real u;
    output Real y;
  algorithm
    y := if u > 0.4 and u < 0.4001 then 1 else 0;
    annotation(GenerateEvents = true);
  end f;
  Real x(start=0, fixed=true);
  Real p = 1.0*(if time > 0.7 and time < 0.7001 then 1 else 0);
  Real y = 1.0*integer(3*time);
  Integer n(start=0, fixed=true);
equation
  der(x) = 1e4*f(time);
  when p > 0.5 then
    n = pre(n) + 1;
  end when;
end EventsOfAWholeMadeReal;
