// section: 4.9
// refuse: R035 4
model AttributeOfAnAttribute
  Real x(start(min = 3)) = time;
end AttributeOfAnAttribute;
