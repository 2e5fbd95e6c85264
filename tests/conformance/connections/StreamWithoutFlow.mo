// section: 15.1
// refuse: R077 4
model StreamWithoutFlow
  connector S
    stream Real s;
  end S;
  model M
    S s(s=1);
  end M;
  M m;
end StreamWithoutFlow;
