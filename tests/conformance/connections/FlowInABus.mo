// section: 9.1.3
// refuse: R070 5
model FlowInABus
  expandable connector EC
    flow Real f;
  end EC;
  EC ec;
end FlowInABus;
