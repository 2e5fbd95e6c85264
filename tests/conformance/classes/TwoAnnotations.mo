// section: A.2.2
// refuse: P022 6
model TwoAnnotations "of two, which one holds would be open"
  Real x = time;
  annotation(experiment(StopTime=1));
  annotation(experiment(StopTime=2));
end TwoAnnotations;
