// section: 12.4.4
// value: x at 0.2 = -0.2, x = 1, n = 2, k = 1
model AssignedInEveryCaseThatComes "What is not assigned in some case is used in no such case"
  type E = enumeration(a, b);
  function f
    input Real u;
    output Real y;
  algorithm
    if u > 0.5 then
      y := u;
    elseif u <= 0.5 then
      y := -u;
    end if;
  end f;
  function number
    input E e;
    output Integer y;
  algorithm
    if e == E.a then
      y := 1;
    elseif e == E.b then
      y := 2;
    end if;
  end number;
  function last
    input Integer n;
    input Real u;
    output Real y;
  algorithm
    for i in 1:n loop
      y := u*i;
    end for;
  end last;
  E e = if time > 0.5 then E.b else E.a;
  Real x = f(time);
  Integer n = number(e);
  Real k = last(integer(1 + 0.5*time), time);
end AssignedInEveryCaseThatComes;
