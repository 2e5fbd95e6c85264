// section: 11.2.3
// value: s[1] = -3, s[4] = 8, k = 1
model BubbleSort "a loop of unknown length over an array that changes, at run time"
  function sort
    input Real u[:];
    output Real y[size(u, 1)] = u;
  protected
    Real t;
    Boolean swapped = true;
  algorithm
    while swapped loop
      swapped := false;
      for i in 1:size(u, 1) - 1 loop
        if y[i] > y[i + 1] then
          t := y[i];
          y[i] := y[i + 1];
          y[i + 1] := t;
          swapped := true;
        end if;
      end for;
    end while;
  end sort;
  Real s[4] = sort({5, -3, 8, 1}*time);
  Real k = s[2];
end BubbleSort;
