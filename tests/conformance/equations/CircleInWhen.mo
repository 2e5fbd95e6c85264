// section: 8.3.5
// refuse: S013 7
model CircleInWhen
  Real a(start = 0, fixed = true), b(start = 0, fixed = true);
equation
  when time > 0.5 then
    a = b + 1;
    b = a + 1;
  end when;
end CircleInWhen;
