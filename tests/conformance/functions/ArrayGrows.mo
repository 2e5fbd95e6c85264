// section: 12.4.5
// value: x[1] = 1, x[2] = 2, n = 2
model ArrayGrows
  function positive
    input Integer x[:];
    output Integer y[:];
  algorithm
    for i in 1:size(x, 1) loop
      if x[i] > 0 then
        y := cat(1, y, x[i:i]);
      end if;
    end for;
  end positive;
  parameter Integer a[:] = {-2, 1, 0, -1, 2};
  Integer x[:] = positive(a);
  Integer n = size(x, 1);
end ArrayGrows;
