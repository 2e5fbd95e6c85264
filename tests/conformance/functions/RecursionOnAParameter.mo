// section: 12.4
// value: n = 2, x[2] = 1, v[3] = 3
model RecursionOnAParameter "a size from a recursive function; no rows above a vector"
  function f
    input Integer m;
    output Integer n;
  algorithm
    n := 1;
    if mod(m, 2) == 0 then
      if m == 2 then
        n := 1;
      else
        n := 2*f(integer(m/2));
      end if;
    end if;
  end f;
  parameter Integer m = 6;
  final parameter Integer n = f(m);
  Real x[n] = fill(time, n);
  Real v[3] = vector([zeros(0, 1); {1, 2, 3}]);
end RecursionOnAParameter;
