// section: 8.3.5
// value: n = 2, n at 0.5 = 1
model ElsewhenLater "the second branch fires at its own event"
  Integer n(start=0, fixed=true);
equation
  when time > 0.32 then
    n = 1;
  elsewhen time > 0.72 then
    n = 2;
  end when;
end ElsewhenLater;
