// section: 5.4
// value: subSystem.ci.x = 0.7
model CI
  outer Boolean isEnabled;
  Real x(start = 1, fixed = true);
equation
  der(x) = if isEnabled then -1 else 0;
end CI;
model SubSystem
  Boolean enableMe = time <= 0.8;
  inner outer Boolean isEnabled = isEnabled and enableMe;
  CI ci;
end SubSystem;
model InnerOuterInOne
  SubSystem subSystem;
  inner Boolean isEnabled = time >= 0.5;
end InnerOuterInOne;
