// section: 4.7
// refuse: R070 3
type T
end T;
model TypeOfNothing
  T t;
end TypeOfNothing;
