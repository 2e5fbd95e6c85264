// section: 10.3.4.1
// value: y = 3, y at 0.3 = 0.9
model SumOverARangeThatVaries
  Real u[3] = {time, 2*time, 4*time};
  Real y = sum(u[i] for i in 1:k);
  Integer k(start=1, fixed=true);
  equation
    when time > 0.1 then
      k = 2;
    end when;
end SumOverARangeThatVaries;
