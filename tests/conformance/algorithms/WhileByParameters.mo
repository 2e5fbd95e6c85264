// section: 11.2.3
// value: x = 3, y = 6
model WhileByParameters "parameters decide how often a loop runs, and what breaks it"
  parameter Integer n = 3;
  parameter Real most = 5;
  Real x, y;
protected
  Integer i;
algorithm
  x := 0;
  i := 1;
  while i <= n loop
    x := x + 1;
    i := i + 1;
  end while;
algorithm
  y := 0;
  for k in 1:10 loop
    y := y + k;
    if y > most then
      break;
    end if;
  end for;
end WhileByParameters;
