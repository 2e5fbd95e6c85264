// section: 7.2.6
// refuse: R031 9
model TF
  parameter Real b[:] = {1};
  parameter Real a[:] = {1, 1};
end TF;
model FinalClassModified
  final model MyTF = TF(b = {1, 2});
  MyTF tf2(a = {1, 2});
end FinalClassModified;
