// section: 12.4.4
// value: y at 0.25 = 0.25, y = 3, k = 5, z = 10
model SizeFromADefault "A constant argument decides a size in a function that runs at run time"
  function f
    input Real u;
    input Integer m = 3;
    output Real y;
    output Integer k;
  protected
    Real w[m] = fill(u, m);
  algorithm
    y := 0;
    k := 0;
    while k < 10 loop
      k := k + 1;
      for i in 1:m loop
        if u < 0.5 then
          y := w[i];
          return;
        end if;
      end for;
      if k >= 5 then
        y := sum(w);
        break;
      end if;
    end while;
  end f;
  Real y, k, z;
equation
  (y, k) = f(time);
  z = f(time, 10);
end SizeFromADefault;
