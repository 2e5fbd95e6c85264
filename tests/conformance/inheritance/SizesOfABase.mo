// section: 7.1
// refuse: P002 5
model SizesOfABase "a class is extended, not an array of it"
  type T
    extends Real[2];
  end T;
  T x = {1, 2};
end SizesOfABase;
