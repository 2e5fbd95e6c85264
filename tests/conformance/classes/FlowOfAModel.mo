// section: 4.4.2.2
// refuse: R070 4
model FlowOfAModel "only connectors hold flows"
  flow Real x = 1;
end FlowOfAModel;
