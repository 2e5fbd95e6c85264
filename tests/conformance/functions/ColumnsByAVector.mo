// section: 10.5
// value: y[1] at 0.5 = 2.5, y[2] at 0.5 = 25, y[1] = 4, s = 12
model ColumnsByAVector "Columns picked by a vector that is known, in a function that runs at run time"
  function rows
    input Real u;
    input Real table[:, :];
    input Integer columns[:];
    output Real y[size(columns, 1)];
  protected
    Integer i = 1;
  algorithm
    while i < size(table, 1) - 1 and u >= table[i + 1, 1] loop
      i := i + 1;
    end while;
    y := table[i, columns] + (table[i + 1, columns] - table[i, columns])*(u - table[i, 1])/(table[i + 1, 1] - table[i, 1]);
  end rows;
  function upTo
    input Real u;
    input Integer n;
    output Real s = 0;
  protected
    Real a = u;
  algorithm
    while a < 10 loop
      a := a*10;
      s := s + sum(k*u for k in 1:n);
    end while;
  end upTo;
  parameter Real table[4, 3] = {{0, 0, 0}, {1, 1, 10}, {2, 4, 40}, {3, 9, 90}};
  parameter Integer n = 3;
  Real y[2] = rows(time + 1, table, {2, 3});
  Real s = upTo(time + 1, n);
end ColumnsByAVector;
