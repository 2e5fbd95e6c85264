// section: 7.2.6
// refuse: R033 8
model Final
  model A
    final replaceable Real x = 1;
  end A;
  extends A;
  redeclare Real x = 2;
end Final;
