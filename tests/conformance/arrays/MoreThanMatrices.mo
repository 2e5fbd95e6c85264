// section: 10.3.5
// value: t[2,1,2] = 4, t[1,1,1] = 1, c[2,1,1] = 1, s[2] = 12
model MoreThanMatrices "transpose, [...; ...] and sums of arrays of any number of dimensions"
  Real t[2, 1, 2] = transpose({{{1, 2}, {3, 4}}});
  Real c[2, 1, 1] = [{{{2}}}; time];
  Real s[2] = sum({i, 2*i} for i in 1:3);
end MoreThanMatrices;
