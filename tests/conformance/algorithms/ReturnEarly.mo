// section: 11.2.5
// value: y = 2
model ReturnEarly
  function f
    input Real x; output Real y;
  algorithm
    y := 2;
    if x > 0 then
      return;
    end if;
    y := 3;
  end f;
  Real y = f(time + 1);
end ReturnEarly;
