// section: 3.8
// refuse: R055 5
model ConstantOfParameter
  parameter Real p = 1;
  constant Real c = p;
end ConstantOfParameter;
