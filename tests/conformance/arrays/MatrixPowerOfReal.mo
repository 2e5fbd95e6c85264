// section: 10.6.8
// refuse: R042 4
model MatrixPowerOfReal
  Real a[2, 2] = [1, 2; 3, 4]^0.5;
end MatrixPowerOfReal;
