// section: 7.3.3
// refuse: R033 9
model ConstantRedeclared
  model M
    constant Real c = 1;
    Real x = c;
  end M;
  model N
    extends M(redeclare constant Real c = 2);
  end N;
  N n;
end ConstantRedeclared;
