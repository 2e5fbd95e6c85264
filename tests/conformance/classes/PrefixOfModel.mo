// section: 4.4.2.2
// refuse: R072 7
model PrefixOfModel
  model A
    Real x = 1;
  end A;
  constant A a;
end PrefixOfModel;
