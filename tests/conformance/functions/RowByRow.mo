// section: 12.4.6
// value: y[1] = 3, y[2] = 7
model RowByRow
  function total
    input Real v[:];
    output Real s;
  algorithm
    s := sum(v);
  end total;
  Real y[2] = total([1, 2; 3, 4]);
end RowByRow;
