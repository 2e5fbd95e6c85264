// section: 3.7.5, 8.6
// value: a = 1.5, y at 0.45 = 0.45, y = 2.5, x = 1.25, b = 3, z = 3, c = 1.5
model PreOfWhatFollows "pre(y) is y on arrival at the event, though y follows what the when-clause sets"
  discrete Real a(start=0, fixed=true);
  discrete Real b(start=1, fixed=true);
  discrete Real c(start=0, fixed=true);
  Real y = a + time;
  Real z = b;
  Real w = c + time;
  Real x(start=0, fixed=true);
equation
  der(x) = y + 0*z + 0*w;
  when time >= 0.5 then
    a = pre(y) + 1;
  end when;
  when time >= 0.6 then
    b = pre(z) + pre(b) + 1;
  end when;
algorithm
  when time >= 0.5 then
    c := pre(w) + 1;
  end when;
end PreOfWhatFollows;
