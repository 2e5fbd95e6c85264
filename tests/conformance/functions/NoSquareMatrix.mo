// section: 12.4.4
// refuse: R062 10
model NoSquareMatrix
  function total
    input Real A[:, size(A, 1)];
    output Real y;
  algorithm
    y := sum(A);
  end total;
  Real y = total([1, 2, 3; 4, 5, 6]);
end NoSquareMatrix;
