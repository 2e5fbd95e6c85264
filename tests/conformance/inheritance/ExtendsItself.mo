// section: 7.1
// refuse: R011 4
model ExtendsItself
  extends ExtendsItself;
  Real y = 1;
end ExtendsItself;
