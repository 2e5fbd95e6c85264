// code: P022
// line: 8
// hint: write one, at the end of the class
model two_annotations
  Real x = time;
  annotation(
    experiment(StopTime=1));
  annotation(experiment(StopTime=2));
end two_annotations;
