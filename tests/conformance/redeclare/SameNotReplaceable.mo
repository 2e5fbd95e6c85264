// section: 7.3.1
// refuse: R033 10
model SameNotReplaceable
  model H
    model T
      Real y = 2;
    end T;
  end H;
  extends H;
  redeclare model extends T
  end T;
  T t;
end SameNotReplaceable;
