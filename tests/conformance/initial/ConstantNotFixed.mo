// section: 4.9.6
// refuse: R035 4
model ConstantNotFixed "fixed of a constant"
  constant Real c(fixed=false) = 1;
  Real x = c;
end ConstantNotFixed;
