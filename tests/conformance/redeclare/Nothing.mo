// section: 7.3
// refuse: R032 8
model Nothing
  model A
    Real x = 1;
  end A;
  extends A;
  redeclare Real y = 2;
end Nothing;
