// section: 10.3.4.1
// refuse: F021 5
model SumOverARangeOfNoArray
  Integer k(start=0, fixed=true);
  Real y = sum(i*time for i in 1:k) ;
  equation
    when sample(0.1, 0.2) then
      k = pre(k) + 1;
    end when;
end SumOverARangeOfNoArray;
