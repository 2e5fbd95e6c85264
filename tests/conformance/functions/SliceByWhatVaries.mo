// section: 10.5
// value: y at 0.4 = 4, y = 7.5, z = 8, v[3] = 4
model SliceByWhatVaries "a slice of known size, whose bounds follow a loop without a known end"
  function between
    input Real table[:, 2], x;
    output Real y;
  protected
    Integer i = 1;
    Real two[2];
  algorithm
    while i < size(table, 1) - 1 and x > table[i + 1, 1] loop
      i := i + 1;
    end while;
    two := table[i:i + 1, 2];
    y := two*{0.5, 0.5};
  end between;
  function pairs
    input Integer n;
    output Real v[4] = zeros(4);
  algorithm
    for i in 1:n loop
      v[i:2:i + 2] := v[i:2:i + 2] + {1, i};
    end for;
    v[3] := v[3] + 3;
  end pairs;
  Integer k = integer(2.0001*time);
  Real y = between([0, 1; 0.3, 3; 0.5, 5; 0.9, 7; 2, 8], time), v[4] = pairs(k), z = sum(v);
end SliceByWhatVaries;
