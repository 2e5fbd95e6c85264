// section: 12.9
// refuse: R070 4
model ExternalModel
  external "C" work();
end ExternalModel;
