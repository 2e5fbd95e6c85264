// section: 8.6
// value: x at 0 = -2, n at 0 = 2, y at 0 = 1
model RootOfTheFirstWholeNumber "what time decides has its value before the initial system is solved"
  Integer n = k + 1;
  Integer k = if time < 2 then 1 else 3;
  Real x(start=-2);
  Real y(start=1);
equation
  x*x - 5*(k - 1)*x - 4 = 0;
  y^3 + y = 4/n;
end RootOfTheFirstWholeNumber;
