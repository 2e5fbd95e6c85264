// section: 11.2.3
// value: n = 111
model Collatz "whole numbers in a loop of unknown length"
  function f
    input Integer n;
    output Integer k = 0;
  protected
    Integer m = n;
  algorithm
    while m > 1 loop
      m := if mod(m, 2) == 0 then div(m, 2) else 3*m + 1;
      k := k + 1;
    end while;
  end f;
  Integer c(start=27, fixed=true), n = f(c);
equation
  when time > 2 then
    c = 1;
  end when;
end Collatz;
