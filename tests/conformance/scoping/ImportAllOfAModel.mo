// section: 13.2.1
// refuse: R075 9
model ImportAllOfAModel
  encapsulated model A
    model B
      Real x = 1;
    end B;
  end A;
  import ImportAllOfAModel.A.*;
  B b;
end ImportAllOfAModel;
