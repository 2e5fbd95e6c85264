// section: 8.3.5
// value: a = 1, b = 2
model WhenFromWhen
  Integer a(start=0, fixed=true), b(start=0, fixed=true);
equation
  when time > 0.5 then
    a = 1;
  end when;
  when a > 0 then
    b = a + 1;
  end when;
end WhenFromWhen;
