// section: 13.2.1
// refuse: R075 8
model ImportOfModel
  encapsulated model P
    Real x = 1;
    type T = Real;
  end P;
  import ImportOfModel.P.*;
  T y = 1;
end ImportOfModel;
