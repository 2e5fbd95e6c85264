// section: 10.3.4
// value: y = 5
model SumOfBracesOverWhatVaries
  function f
    input Real a[:];
    input Integer n;
    output Real y;
  algorithm
    y := sum({a[i]^2 for i in 1:n});
  end f;
    Integer n(start=1, fixed=true);
    Real y = f({time, 2, 1}, n);
  equation
    when time > 0.5 then
      n = 2;
    end when;
end SumOfBracesOverWhatVaries;
