// section: 8.6
// value: c = -3, b = -2
model WholeNumberWithASign "Integers that equal the negative of others"
  Integer a = 2;
  Integer b = -a;
  Integer c = b - 1;
end WholeNumberWithASign;
