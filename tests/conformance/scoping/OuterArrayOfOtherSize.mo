// section: 5.4
// refuse: R076 5
model OuterArrayOfOtherSize
  model A
    outer Real p[6];
    Real x = p[5];
  end A;
  inner Real p[10] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  A a;
end OuterArrayOfOtherSize;
