// section: 4.7
// refuse: R071 5
model TypeWithComponent
  type T
    extends Real;
    Real x;
  end T;
  T t = 1;
end TypeWithComponent;
