// section: 7.3
// refuse: R033 8
model Constant
  model A
    replaceable constant Real x = 1;
  end A;
  extends A;
  redeclare Real x = 2;
end Constant;
