// section: 7.2.5
// refuse: R036 7
model SizeOfModifierDiffers
  model A
    parameter Real p = 1;
  end A;
  A a[2](p={4, 5, 6});
end SizeOfModifierDiffers;
