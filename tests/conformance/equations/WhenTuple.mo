// section: 8.3.5
// value: a = 0.5, b = 0.25
model WhenTuple "several results of a function at an event"
  function f
    input Real t;
    output Real a = t;
    output Real b = t*t;
  end f;
  discrete Real a(start=0, fixed=true), b(start=0, fixed=true);
equation
  when time >= 0.5 then
    (a, b) = f(time);
  end when;
end WhenTuple;
