// section: 3.6.1
// value: p = 30, q[1] = 3, r[2,2] = 20, s[2] = 20, t = 3
record R
  Real x[2];
end R;
model PartsOfParentheses
  R a[3];
  Real p = a[3].x[2];
  Real q[2] = a[3].x;
  Real r[3, 2] = a.x;
  Real s[2] = (a.x)[2, :];
  Real t = ((a[3]).x)[1];
equation
  for i in 1:3 loop
    a[i].x = {i, 10*i};
  end for;
end PartsOfParentheses;
