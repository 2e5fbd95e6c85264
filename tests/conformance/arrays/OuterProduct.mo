// section: 10.3.5
// value: a[2,1] = 6, a[1,2] = 4
model OuterProduct
  Real a[2, 2] = outerProduct({1, 2}, {3, 4});
end OuterProduct;
