// section: 10.7
// value: a[1,2] = 0, a[2,3] = 0
model EmptyMatrixProduct
  Real a[2, 3] = fill(1.0, 2, 0)*fill(2.0, 0, 3);
end EmptyMatrixProduct;
