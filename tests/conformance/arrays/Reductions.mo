// section: 10.3.4
// value: a = 55, b = 95, c[5] = 24, c[1] = 1, d = 49, e[4] = 5.5, f[10] = 10, t[1,3] = 2, t2[1,3] = 2
model Reductions
  Real a = sum(i for i in 1:10);
  Real b = sum(i^2 for i in {1, 3, 7, 6});
  Real c[5] = {product(j for j in 1:i) for i in 0:4};
  Real d = max(i^2 for i in {3, 7, 6});
  Real e[4] = {r for r in 1.0:1.5:5.5};
  Real f[10] = array(i for i in 1:10);
  Real t[3, 3] = {i - j for i in 1:3, j in 1:3};
  Real t2[3, 3] = {{i - j for i in 1:3} for j in 1:3};
end Reductions;
