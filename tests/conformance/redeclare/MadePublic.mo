// section: 7.3
// refuse: R037 9
model MadePublic
  model A
  protected
    replaceable Real x = 1;
  end A;
  extends A;
  redeclare Real x = 2;
end MadePublic;
