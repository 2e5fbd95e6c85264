// section: 15.1
// refuse: R070 4
model StreamInAModel
  stream Real x = 1;
end StreamInAModel;
