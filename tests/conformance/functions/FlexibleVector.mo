// section: 12.4.5
// value: n = 3, x[1] = 1, x[3] = 5
model FlexibleVector
  function odd
    input Integer v[:];
    output Integer w[:];
  algorithm
    for k in v loop
      if mod(k, 2) == 1 then
        w := cat(1, w, {k});
      end if;
    end for;
  end odd;
  Integer x[:] = odd(1:6);
  Integer n = size(x, 1);
end FlexibleVector;
