// section: 12.4.4
// value: y = 10
model SquareMatrix
  function total
    input Real A[:, size(A, 1)];
    output Real y;
  algorithm
    y := sum(A);
  end total;
  Real y = total([1, 2; 3, 4]);
end SquareMatrix;
