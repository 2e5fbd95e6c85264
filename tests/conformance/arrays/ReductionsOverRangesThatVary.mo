// section: 10.3.4.1
// value: y = 5, z = 5, p at 0.3 = 1, p = 5, q at 0.3 = 1, q = 2, e at 0.2 = 0, s = 6, s at 0.5 = 4
model ReductionsOverRangesThatVary
  Real u[3] = {1, 2, 4};
  Real v[3] = {1, 2, 3};
  Integer k(start=0, fixed=true);
  Real y = u[1:k]*v[1:k] ;
  Real z = sum(u[1:k].*v[1:k]);
  Real p = sum(u[i]*i for i in 1:k);
  Real q = max(u[1:k]);
  Real e = sum(u[1:k]);
  Real s = sum(sum(u[j]*u[i] for j in 1:i - 1) for i in 1:k) + sum(u[2:3]) - 2;
  equation
    when {time > 0.25, time > 0.75} then
      k = pre(k) + 1;
    end when;
end ReductionsOverRangesThatVary;
