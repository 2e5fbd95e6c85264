// section: 10.4
// value: r2[2,6] = 12, m1[3,2] = 6, m2[2,2] = 5, m3[6,1] = 6
model ArrayConstructor
  Real[3] v = array(1, 2, 3.0);
  Real[2, 3] r1 = cat(1, {{1.0, 2.0, 3}}, {{4, 5, 6}});
  Real[2, 6] r2 = cat(2, r1, 2*r1);
  Real[3] v2 = {4, 5, 6};
  Real[3, 2] m1 = [v, v2];
  Real[3, 2] m2 = [v, [4; 5; 6]];
  Real[6, 1] m3 = [v; v2];
  Real[2, 1] m4 = [1; 2];
end ArrayConstructor;
