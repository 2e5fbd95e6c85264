// section: 7.2.5
// value: a[1].k = 4, a[2].k = 4
model EachForArray
  model A
    parameter Real k = 1;
  end A;
  A a[2](each k=4);
end EachForArray;
