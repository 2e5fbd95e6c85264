// section: 4.7
// refuse: R070 5
model TypeWithComponents "a type with elements"
  type T
    Real x;
  end T;
  T t(x=1);
end TypeWithComponents;
