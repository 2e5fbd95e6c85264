// section: 3.7.4
// refuse: R053 4
model SmoothOfANegativeOrder "smooth with a negative order"
  Real x = smooth(-1, time);
end SmoothOfANegativeOrder;
