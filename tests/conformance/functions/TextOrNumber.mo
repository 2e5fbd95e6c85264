// section: 3.6.5
// refuse: R021 8
model TextOrNumber
  function f
    input Real u;
    output Real y;
  algorithm
    y := if u > 0 then "a" else 2;
  end f;
  Real y = f(time);
end TextOrNumber;
