// section: 2.4.1
// value: a = 1, b = 0.5, c = 1200, d = 0.03, e = 5, f = 2.25, g = 10
model FormsOfNumbers "digits may lack on either side of the point"
  parameter Real a = 1., b = .5, c = 1.2E3, d = 3e-2, f = 9*.25, g = .1e2;
  parameter Integer e = 005;
  Real x = time;
end FormsOfNumbers;
